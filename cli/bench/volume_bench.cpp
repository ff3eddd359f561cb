#include "cli/bench/volume_bench.h"

#include <memory>
#include <utility>

#include "common/compare/compare.h"
#include "common/median.h"
#include "loader/models/load_volume.h"
#include "renderer/engine_checks.h"
#include "renderer/gl/open_gl.h"
#include "renderer/render.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief::cli {
namespace {

constexpr const char* kTruthEngine = "volume-truth";
constexpr const char* kReferenceEngine = "volume-reference";  ///< of what has no truth

/// A row while it is timed.
struct Timed {
  std::unique_ptr<PreparedModel> prepared;
  std::vector<double> frame_ms;
  std::vector<double> gpu_ms;
  RenderResult last;
};

/// A view by an engine. Surfaces have one sample a pixel, as in other benches.
Result<RenderSettings> settings_for(const BenchView& view, const EngineEntry& engine) {
  RELIEF_TRY_ASSIGN(auto settings, bench_row(view, engine, {}));
  settings.raytrace.samples = settings.samples;
  return settings;
}

Result<std::vector<VolumeBenchRow>> rows_of(const BenchView& view) {
  std::vector<VolumeBenchRow> rows;
  for (const EngineEntry& engine : engines()) {
    if (engine.surfaces_by.empty()) continue;
    VolumeBenchRow row;
    RELIEF_TRY_ASSIGN(row.settings, settings_for(view, engine));
    row.is_default = engine.name == kVolumeEngine;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The truth's image and engine.
Result<std::pair<Image, std::string>> truth_of(const RenderModel& model, const BenchView& view,
                                               Progress& progress) {
  RELIEF_TRY_ASSIGN(const EngineEntry* const exact, engine_named(kTruthEngine));
  if (form_for(*exact, model)) {
    RELIEF_TRY_ASSIGN(const auto settings, settings_for(view, *exact));
    if (auto drawn = render(model, settings, progress))
      return std::pair(std::move(drawn->image), exact->name);
    if (progress.cancelled()) return interrupted_error();
  }
  RELIEF_TRY_ASSIGN(const EngineEntry* const reference, engine_named(kReferenceEngine));
  RELIEF_TRY_ASSIGN(const auto settings, settings_for(view, *reference));
  RELIEF_TRY_ASSIGN(auto drawn, render(model, settings, progress));
  return std::pair(std::move(drawn.image), reference->name);
}

Status prepare(const RenderModel& model, const std::vector<VolumeBenchRow>& rows,
               const std::shared_ptr<const OpenGl>& opengl, std::vector<Timed>& timed) {
  const auto environments = std::make_shared<EnvironmentCache>();
  for (const VolumeBenchRow& row : rows) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(row.settings.engine));
    RELIEF_TRY(check_engine(*engine, row.settings, model));
    RELIEF_TRY_ASSIGN(auto prepared, engine->prepare({.model = model,
                                                      .views = {&row.settings, 1},
                                                      .opengl = opengl,
                                                      .environments = environments}));
    timed.push_back({std::move(prepared), {}, {}, {}});
  }
  return {};
}

Status measure(Timed& timed, const Image& truth, bool is_truth, Progress& progress,
               VolumeBenchRow& row) {
  row.frame_ms = median_of(timed.frame_ms);
  if (!timed.gpu_ms.empty()) row.gpu_ms = median_of(timed.gpu_ms);
  row.covered_pixels = timed.last.covered_pixels;
  row.fragments = timed.last.fragments;
  if (is_truth) return {};
  const FlipOptions options{FlipRange::Ldr, kFlipPixelsPerDegree};
  RELIEF_TRY_ASSIGN(const auto found, compare_images(timed.last.image, truth, options, progress));
  row.psnr_db = found.psnr_db;
  row.flip_mean = found.flip.mean;
  return {};
}

}  // namespace

Result<VolumeBench> bench_volumes(const LoadedScene& scene, const BenchView& view, int frames,
                                  Progress& progress) {
  VolumeBench result;
  result.frames = frames;
  RELIEF_TRY_ASSIGN(result.rows, rows_of(view));
  const RenderModel model = scene.forms();
  QuietProgress quiet(progress);
  RELIEF_TRY_ASSIGN(const auto truth, truth_of(model, view, quiet));
  result.truth = truth.second;
  RELIEF_TRY_ASSIGN(const auto opengl, OpenGl::create(view.platform, false, false));
  std::vector<Timed> timed;
  RELIEF_TRY(prepare(model, result.rows, opengl, timed));
  const int rounds = result.warm_up + frames;
  progress.begin_stage("frames", static_cast<std::uint64_t>(rounds));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < timed.size(); ++k) {
      RELIEF_TRY_ASSIGN(timed[k].last, timed[k].prepared->render(result.rows[k].settings, quiet));
      if (progress.cancelled()) return interrupted_error();
      if (round < result.warm_up) continue;
      timed[k].frame_ms.push_back(timed[k].last.frame_ms);
      if (timed[k].last.gpu_ms) timed[k].gpu_ms.push_back(*timed[k].last.gpu_ms);
    }
    progress.advance(1);
  }
  for (std::size_t k = 0; k < timed.size(); ++k) {
    VolumeBenchRow& row = result.rows[k];
    RELIEF_TRY(measure(timed[k], truth.first, row.settings.engine == result.truth, quiet, row));
    if (find_engine(row.settings.engine)->capabilities.needs_opengl)
      result.renderer = timed[k].last.renderer;
  }
  return result;
}

}  // namespace relief::cli
