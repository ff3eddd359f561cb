// relief bench: every way to draw a scene, timed in turns and compared with the truth.
#include "renderer/bench/bench.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "cli/bench_accuracy.h"
#include "cli/bench_plot.h"
#include "cli/bench_report.h"
#include "cli/bench_rows.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/load_scene.h"
#include "cli/paths.h"
#include "cli/render_options.h"
#include "cli/render_plan.h"
#include "common/file.h"

namespace relief::cli {
namespace {

constexpr const char* kExamples =
    "In brackets: what is taken where an option is not given.\n"
    "Draws each way in turns: frame k of every row before frame k + 1 of any, so that a machine\n"
    "that drifts drifts for all. Times are medians, after two rounds that are not counted. The\n"
    "bound shades as many pixels as the picture covers and nothing else; the mesh is the input's,\n"
    "if it has faces. The truth is ray-traced: the scene's triangles, or else its patches. Of a\n"
    ".json scene the first view is drawn; its engine, primitive, interpolation and background do\n"
    "not count. A ratio is the row's time over that of multipass with radius factor 2 (its faster\n"
    "primitive), of the bound, of the mesh. Bytes are those of the model on the GPU.\n"
    "\n"
    "Examples:\n"
    "  relief bench dragon.ply.gz --plot bench.svg\n"
    "  relief bench dragon.relief --material mirror --env studio.hdr --frames 50 --json";

constexpr int kFrames = 20;

struct Arguments {
  RenderArguments picture;
  std::filesystem::path plot;  ///< empty: none
};

Status write_text(const std::filesystem::path& path, const std::string& text) {
  return write_file_atomically(path, std::as_bytes(std::span<const char>(text)));
}

Result<BenchResult> measure(const RenderPlan& plan, const RenderArguments& arguments) {
  ConsoleProgress progress;
  const auto scene = load_scene(plan.models, {.patches = true, .raytrace = true}, progress);
  if (!scene) return scene.error();
  const Picture& picture = plan.pictures.front();
  const auto base = render_settings_for(picture, scene->patches, arguments);
  if (!base) return base.error();
  BenchJob job;
  job.model.patches = &scene->patches;
  if (scene->mesh_is_input) job.model.mesh = &*scene->mesh;
  job.rows = bench_rows(*base);
  job.reference = find_default(job.rows);
  job.frames = arguments.frames.value_or(kFrames);
  auto times = bench(job, progress);
  if (!times) return times.error();
  auto accuracy = measure_accuracy(scene->forms(), job.rows, progress);
  if (!accuracy) return accuracy.error();
  BenchResult result;
  result.scene = arguments.input.string();
  result.view = picture.view;
  result.reference = job.reference;
  result.frames = job.frames;
  result.warm_up = job.warm_up;
  result.samples = count_samples(scene->patches);
  if (scene->mesh_is_input) result.mesh_triangles = scene->mesh->triangles.size();
  result.rows = std::move(job.rows);
  result.times = std::move(*times);
  result.accuracy = std::move(*accuracy);
  return result;
}

int run(const Arguments& arguments) {
  const auto plan = make_plan(arguments.picture);
  if (!plan) return fail(plan.error());
  const auto inputs = find_inputs(*plan, {});
  if (!inputs) return fail(inputs.error());
  if (!arguments.plot.empty()) {
    const Status writable = check_output(arguments.plot, *inputs);
    if (!writable) return fail(writable.error());
  }
  const auto result = measure(*plan, arguments.picture);
  if (!result) return fail(result.error());
  if (!arguments.plot.empty()) {
    const Status written = write_text(arguments.plot, plot_as_svg(plot_of(*result)));
    if (!written) return fail(written.error());
  }
  return arguments.picture.json ? print_json(as_json(*result)) : print_result(as_text(*result));
}

}  // namespace

void add_bench(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("bench", "Time every way to draw a scene against the truth");
  const auto arguments = std::make_shared<Arguments>();
  RenderArguments& picture = arguments->picture;
  sub->add_option("SCENE", picture.input, "A .relief file, a scan, a mesh or a .json scene")
      ->required()
      ->option_text("FILE");
  add_camera_options(*sub, picture.settings);
  add_material_options(*sub, picture.settings);
  sub->add_option("--frames", picture.frames, "Timed frames of each row (20)")
      ->check(CLI::Range(1, 100000))
      ->option_text("N");
  add_platform_option(*sub, picture.platform);
  sub->add_option("--plot", arguments->plot,
                  "Write accuracy against time, with the Pareto front marked")
      ->check([](const std::string& name) {
        return ending(name) == ".svg" ? std::string() : "expected a name that ends in .svg";
      })
      ->option_text("OUT.svg");
  sub->add_flag("--json", picture.json, "Print one JSON object on standard output");
  sub->footer(kExamples);
  sub->callback([arguments, &command] {
    check_camera(arguments->picture.settings);
    command = [arguments] { return run(*arguments); };
  });
}

}  // namespace relief::cli
