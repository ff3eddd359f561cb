// relief bench: times every method to draw a scene and compares it with the truth.
#include "renderer/bench/bench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/bench/bench_accuracy.h"
#include "cli/bench/bench_engines.h"
#include "cli/bench/bench_plan.h"
#include "cli/bench/bench_rows.h"
#include "cli/bench/bench_sweep.h"
#include "cli/bench/volume_bench.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options/engine_options.h"
#include "cli/options/paths.h"
#include "cli/options/read_options.h"
#include "cli/options/render_options.h"
#include "cli/options/values.h"
#include "cli/plot/bench_plot.h"
#include "cli/reports/bench_report.h"
#include "cli/reports/volume_bench_report.h"
#include "cli/trade/trade_command.h"
#include "common/io/extension.h"
#include "common/io/file.h"
#include "loader/load_scene.h"
#include "loader/models/load_volume.h"

namespace relief::cli {
namespace {

constexpr const char* kBenchExamples =
    "Draws all rows in turns: frame k of every row before frame k + 1 of any, so that a slower\n"
    "machine slows all rows. Times are medians, after two rounds that are not timed. The truth is\n"
    "ray traced: the triangles of the scene, or else of its patches. The bound shades as many "
    "pixels\n"
    "as the image covers and does nothing else. The mesh is the input's, if it has faces. Of a "
    ".json\n"
    "scene only the first view is drawn, without its background, with all engines. A ratio is the\n"
    "row's time over that of multipass with its default radius factor (its faster primitive), of "
    "the\n"
    "bound, of the mesh. Bytes are those of the model on the GPU. Of volumes and 3D Gaussians "
    "there\n"
    "is a row for each engine that draws them, compared with volume-truth or volume-reference.\n"
    "With --engines rows on the CPU have turns of their own, after the others: as many as fit "
    "into\n"
    "10 seconds of the slowest, 1 to 5.\n"
    "\n"
    "Examples:\n"
    "  relief bench dragon.ply.gz --plot bench.svg\n"
    "  relief bench dragon.ply.gz --engines all --plot engines.svg\n"
    "  relief bench --trade dragon.ply.gz --ask 'fastest at 40 dB' --report dragon.html\n"
    "  relief bench dragon.relief --material mirror --env studio.hdr --frames 50 --json";

constexpr int kFrames = 20;

/// The key of the option of patches that all rows share.
constexpr std::string_view kCull = "cull";

struct BenchArguments {
  RenderArguments image;
  std::filesystem::path plot;  ///< empty: none
  BenchChoice choice;
  TradeArguments trade;
};

Status write_text(const std::filesystem::path& path, const std::string& text) {
  return write_file_atomically(path, std::as_bytes(std::span<const char>(text)));
}

Result<BenchResult> measure(const ScenePlan& scene, const BenchArguments& arguments) {
  ConsoleProgress progress;
  RELIEF_TRY_ASSIGN(const auto models, load_for_bench(scene, arguments.choice, progress));
  const PlannedView& view = scene.views.front();
  const BenchView bench_view{scene, view, models.scene.patches, arguments.image.platform};
  RELIEF_TRY_ASSIGN(auto rows, plan_bench(models, bench_view, arguments.choice));
  auto& [job, result] = rows;
  job.frames = arguments.image.frames.value_or(kFrames);
  RELIEF_TRY_ASSIGN(auto times, bench(job, progress));
  const TriangleMesh* const mesh = models.scene.mesh ? &*models.scene.mesh : nullptr;
  const auto normals = result.compares_engines ? CompareNormals::Yes : CompareNormals::No;
  RELIEF_TRY_ASSIGN(auto accuracy, measure_accuracy(job.rows, mesh, normals, progress));
  result.scene = arguments.image.input.string();
  result.view = view.name;
  result.frames = job.frames;
  result.warm_up = job.warm_up;
  result.times = std::move(times);
  result.accuracy = std::move(accuracy);
  return std::move(result);
}

/// Of volumes and 3D Gaussians, alone or among surfaces.
Result<VolumeBench> measure_volumes(const ScenePlan& plan, const BenchArguments& arguments) {
  if (!arguments.plot.empty() || arguments.choice.sweep || !arguments.choice.engines.empty()) {
    return make_error(
        "{}: has volumes or 3D Gaussians, for which there is no --plot, no --sweep and no "
        "--engines",
        arguments.image.input.string());
  }
  ConsoleProgress progress;
  LoadOptions options;
  options.volume = arguments.image.volume;
  RELIEF_TRY_ASSIGN(const auto scene, load_scene(plan, options, progress));
  const BenchView view{plan, plan.views.front(), scene.patches, arguments.image.platform};
  return bench_volumes(scene, view, arguments.image.frames.value_or(kFrames), progress);
}

int run_volume_bench(ScenePlan plan, const BenchArguments& arguments) {
  // What is loaded suits all rows, each of which has an engine of its own.
  const PlannedView view = plan.views.front();
  plan.views.clear();
  for (const EngineEntry& engine : engines()) {
    if (engine.surfaces_by.empty()) continue;
    plan.views.push_back(view);
    plan.views.back().settings.engine = engine.name;
  }
  const auto result = measure_volumes(plan, arguments);
  if (!result) return fail(result.error());
  return arguments.image.json ? print_json(as_json(*result))
                              : print_result(as_text(*result, arguments.image.input.string()));
}

int run_bench(const BenchArguments& arguments) {
  const auto plan = plan_scene(arguments.image.input, arguments.image.settings);
  if (!plan) return fail(plan.error());
  auto inputs = find_inputs(*plan);
  if (!inputs) return fail(inputs.error());
  if (arguments.trade.is_wanted) {
    if (!arguments.trade.truth.empty()) inputs->push_back(arguments.trade.truth);
    return run_trade(*plan, arguments.image, arguments.trade, *inputs);
  }
  if (has_kernels(plan->models, arguments.image.volume)) return run_volume_bench(*plan, arguments);
  for (const auto& [key, value] : arguments.image.settings.options) {
    if (key == kCull) continue;
    return fail(make_error("{}: --{} is for volumes and 3D Gaussians, and the scene has none",
                           arguments.image.input.string(), key));
  }
  if (!arguments.plot.empty()) {
    const Status writable = check_output(arguments.plot, *inputs);
    if (!writable) return fail(writable.error());
  }
  const InterruptedFiles unfinished({arguments.plot}, nullptr);
  const auto result = measure(*plan, arguments);
  if (!result) return fail(result.error());
  if (!arguments.plot.empty()) {
    const Status written = write_text(arguments.plot, plot_as_svg(plot_of(*result)));
    if (!written) return fail(written.error());
    InterruptedFiles::note_complete();
  }
  return arguments.image.json ? print_json(as_json(*result)) : print_result(as_text(*result));
}

/// Checks that a sweep that converts has a scan or a mesh as input.
void check_sweep(const BenchArguments& arguments) {
  const std::string kind = lower_extension(arguments.image.input);
  const std::optional<Sweep>& sweep = arguments.choice.sweep;
  if (sweep && converts(*sweep) && (kind == ".relief" || kind == ".json"))
    throw CLI::ValidationError("--sweep", "spacing and height-step need a scan or a mesh; found " +
                                              arguments.image.input.string());
}

}  // namespace

void add_bench(CLI::App& app, Command& command) {
  auto* sub = app.add_subcommand("bench",
                                 "Time every method to draw a scene and compare it with the truth");
  const auto arguments = std::make_shared<BenchArguments>();
  RenderArguments& image = arguments->image;
  sub->add_option("SCENE", image.input,
                  "Patch file (.relief), scan, mesh, volume, 3D Gaussians or .json scene")
      ->required()
      ->option_text("FILE");
  add_camera_options(*sub, image.settings);
  add_material_options(*sub, image.settings);
  for (const SharedOption& option : shared_options()) {
    const bool is_for_volumes =
        std::any_of(option.engines.begin(), option.engines.end(),
                    [](const EngineEntry* engine) { return !engine->surfaces_by.empty(); });
    if (option.row.key == kCull || is_for_volumes)
      add_engine_option(*sub, image.settings.options, option);
  }
  sub->add_option("--frames", image.frames, "Frames to time of each row, 1 to 100000 (default 20)")
      ->check(count_from(1, 100000))
      ->option_text("N");
  add_platform_option(*sub, image.platform);
  add_raw_option(*sub, image.volume);
  sub->add_option("--plot", arguments->plot,
                  "SVG to write a plot of accuracy against time to, with the Pareto front marked "
                  "(default: none)")
      ->check([](const std::string& name) {
        return lower_extension(name) == ".svg" ? std::string()
                                               : "expected a name that ends in .svg; found " + name;
      })
      ->option_text("OUT.svg");
  auto* const compared =
      sub->add_option_function<std::string>(
             "--engines",
             [arguments](const std::string& s) { arguments->choice.engines = parse_engines(s); },
             "Compare engines instead of methods: all, or some of them, separated by commas; a row "
             "for what each draws, from points or samples, and with clipping at sharp edges where "
             "it has that (default: every method of the engines on OpenGL)")
          ->option_text(fmt::format("all|{},...", comparable_engines().front()->name));
  sub->add_option_function<std::string>(
         "--sweep", [arguments](const std::string& s) { arguments->choice.sweep = parse_sweep(s); },
         fmt::format(
             "Vary one quantity: a row for each of 1 to 16 values, beside the default method "
             "and multipass; KEY is {}; {} and {} convert the scan again (default: none)",
             fmt::join(sweep_keys(), ", "), kSpacing, kHeightStep))
      ->option_text("KEY=V,V,...")
      ->excludes(compared);
  add_trade_options(*sub, arguments->trade);
  sub->add_flag("--json", image.json, "Print one JSON object on standard output");
  sub->footer(kBenchExamples);
  sub->callback([arguments, &command] {
    check_camera(arguments->image.settings);
    check_sweep(*arguments);
    command = [arguments] { return run_bench(*arguments); };
  });
}

}  // namespace relief::cli
