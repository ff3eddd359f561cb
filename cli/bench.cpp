// relief bench: every way to draw a scene, timed in turns and compared with the truth.
#include "renderer/bench/bench.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/bench/bench_accuracy.h"
#include "cli/bench/bench_rows.h"
#include "cli/bench/bench_sweep.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/paths.h"
#include "cli/options/render_options.h"
#include "cli/plot/bench_plot.h"
#include "cli/reports/bench_report.h"
#include "common/io/extension.h"
#include "common/io/file.h"
#include "loader/load_scene.h"
#include "loader/view_settings.h"
#include "renderer/shading/materials.h"

namespace relief::cli {
namespace {

constexpr const char* kBenchExamples =
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

struct BenchArguments {
  RenderArguments picture;
  std::filesystem::path plot;  ///< empty: none
  std::optional<Sweep> sweep;
};

Status write_text(const std::filesystem::path& path, const std::string& text) {
  return write_file_atomically(path, std::as_bytes(std::span<const char>(text)));
}

/// Conversions of the scene: the first as it is unasked, then those of a sweep.
struct Models {
  LoadedScene scene;
  std::vector<PatchModel> swept;
};

Result<Models> load(const ScenePlan& plan, const std::optional<Sweep>& sweep, Progress& progress) {
  auto scene = load_models(plan.models, {}, {.patches = true, .raytrace = true}, progress);
  if (!scene) return scene.error();
  Models models{std::move(*scene), {}};
  if (!sweep || !converts(*sweep)) return models;
  RELIEF_TRY_ASSIGN(auto swept, convert_sweep(plan.models.front().file, *sweep, progress));
  models.swept = std::move(swept);
  return models;
}

/// All that is to be drawn; what is measured is filled in later.
struct Plan {
  BenchJob job;
  BenchResult result;

  void add(const PatchModel& patches, const RenderSettings& row, std::optional<double> value) {
    job.rows.push_back({&patches, row});
    result.rows.push_back(row);
    result.swept_values.push_back(value);
    result.samples.push_back(count_samples(patches));
  }
};

Plan plan_rows(const Models& models, const RenderSettings& base,
               const std::optional<Sweep>& sweep) {
  Plan plan;
  const PatchModel& unasked = models.scene.patches;
  for (const RenderSettings& row : sweep ? compared_rows(base) : bench_rows(base))
    plan.add(unasked, row, std::nullopt);
  if (sweep) plan.result.swept = name_of(kSwept, sweep->what);
  if (sweep && !converts(*sweep)) {
    const auto rows_of = sweep->what == Swept::RadiusFactor ? radius_factor_rows : level_rows;
    for (const RenderSettings& row : rows_of(base, sweep->values))
      plan.add(unasked, row, std::nullopt);
  }
  for (std::size_t k = 0; k < models.swept.size(); ++k)
    plan.add(models.swept[k], compared_rows(base).front(), sweep->values[k]);
  plan.job.reference = plan.result.reference = find_default(plan.result.rows);
  if (models.scene.mesh_is_input) {
    plan.job.mesh = &*models.scene.mesh;
    plan.result.mesh_triangles = models.scene.mesh->triangles.size();
  }
  return plan;
}

Result<BenchResult> measure(const ScenePlan& scene, const BenchArguments& arguments) {
  ConsoleProgress progress;
  RELIEF_TRY_ASSIGN(const auto models, load(scene, arguments.sweep, progress));
  const PlannedView& view = scene.views.front();
  RELIEF_TRY_ASSIGN(auto base, render_settings_of(scene, view, models.scene.patches));
  base.platform = arguments.picture.platform;
  if (uses(base, Material::Split)) {
    return make_error(
        "the material split is for relief render: most of the rows of relief bench can't show it; "
        "take lit or mirror");
  }
  if (has_two_interfaces(base)) {
    return make_error(
        "glass with two interfaces is for relief render: most of the rows of relief bench can't "
        "show it; take --interfaces 1");
  }
  auto [job, result] = plan_rows(models, base, arguments.sweep);
  job.frames = arguments.picture.frames.value_or(kFrames);
  RELIEF_TRY_ASSIGN(auto times, bench(job, progress));
  const TriangleMesh* const mesh = models.scene.mesh ? &*models.scene.mesh : nullptr;
  RELIEF_TRY_ASSIGN(auto accuracy, measure_accuracy(job.rows, mesh, progress));
  result.scene = arguments.picture.input.string();
  result.view = view.name;
  result.frames = job.frames;
  result.warm_up = job.warm_up;
  result.times = std::move(times);
  result.accuracy = std::move(accuracy);
  return std::move(result);
}

int run_bench(const BenchArguments& arguments) {
  const auto plan = plan_scene(arguments.picture.input, arguments.picture.settings);
  if (!plan) return fail(plan.error());
  const auto inputs = find_inputs(*plan);
  if (!inputs) return fail(inputs.error());
  if (!arguments.plot.empty()) {
    const Status writable = check_output(arguments.plot, *inputs);
    if (!writable) return fail(writable.error());
  }
  const auto result = measure(*plan, arguments);
  if (!result) return fail(result.error());
  if (!arguments.plot.empty()) {
    const Status written = write_text(arguments.plot, plot_as_svg(plot_of(*result)));
    if (!written) return fail(written.error());
  }
  return arguments.picture.json ? print_json(as_json(*result)) : print_result(as_text(*result));
}

/// What is converted anew is a scan.
void check_sweep(const BenchArguments& arguments) {
  const std::string kind = lower_extension(arguments.picture.input);
  if (arguments.sweep && converts(*arguments.sweep) && (kind == ".relief" || kind == ".json"))
    throw CLI::ValidationError("--sweep", "spacing and height-step need a scan or a mesh");
}

}  // namespace

void add_bench(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("bench", "Time every way to draw a scene against the truth");
  const auto arguments = std::make_shared<BenchArguments>();
  RenderArguments& picture = arguments->picture;
  sub->add_option("SCENE", picture.input, "A .relief file, a scan, a mesh or a .json scene")
      ->required()
      ->option_text("FILE");
  add_camera_options(*sub, picture.settings);
  add_material_options(*sub, picture.settings);
  add_cull_option(*sub, picture.settings);
  sub->add_option("--frames", picture.frames, "Timed frames of each row (20)")
      ->check(CLI::Range(1, 100000))
      ->option_text("N");
  add_platform_option(*sub, picture.platform);
  sub->add_option("--plot", arguments->plot,
                  "Write accuracy against time, with the Pareto front marked")
      ->check([](const std::string& name) {
        return lower_extension(name) == ".svg" ? std::string()
                                               : "expected a name that ends in .svg";
      })
      ->option_text("OUT.svg");
  sub->add_option_function<std::string>(
         "--sweep", [arguments](const std::string& s) { arguments->sweep = parse_sweep(s); },
         "One quantity with several values instead: the default way, multipass to compare with, "
         "and a row for each value; spacing and height-step convert the scan anew")
      ->option_text("spacing|height-step|radius-factor|pixels-per-sample=V,V,...");
  sub->add_flag("--json", picture.json, "Print one JSON object on standard output");
  sub->footer(kBenchExamples);
  sub->callback([arguments, &command] {
    check_camera(arguments->picture.settings);
    check_sweep(*arguments);
    command = [arguments] { return run_bench(*arguments); };
  });
}

}  // namespace relief::cli
