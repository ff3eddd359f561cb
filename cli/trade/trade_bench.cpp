#include "cli/trade/trade_bench.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "cli/bench/bench_accuracy.h"
#include "common/median.h"
#include "loader/load_files.h"
#include "preprocess/sample_search.h"
#include "renderer/engine_checks.h"
#include "renderer/geometry/meshes/mesh_of_patches.h"
#include "renderer/geometry/meshes/mesh_of_points.h"

namespace relief::cli {
namespace {

/// Rays of the truth: as many as `raytrace` has by default. A setting with one sample a pixel is
/// compared with an antialiased picture, too, because that is what its user sees.
constexpr int kTruthRays = 16;

Result<TriangleMesh> read_truth(const std::filesystem::path& path, Progress& progress) {
  RELIEF_TRY_ASSIGN(const auto loaded, load_mesh(path, {}, progress));
  if (loaded.points.triangles.empty()) {
    return make_error(
        "{}: has no faces; the truth is a mesh, so name one with --truth, or leave it out",
        path.string());
  }
  return mesh_of_points(loaded.points);
}

/// The surface of a scan without faces that its points can tell: finer than any setting's.
Result<TriangleMesh> finest_patches(TradeFiles& files, Progress& progress) {
  RELIEF_TRY_ASSIGN(
      const TradeFile* const finest,
      files.file_of({{"samples-per-point", kFinestSamplesPerPoint}}, OptionValues(), progress));
  return mesh_of_patches(finest->model);
}

std::optional<Quality> quality_of(const std::vector<TradeKnob>& knobs,
                                  const TradeSetting& setting) {
  for (const auto& [name, quality] : kQualities) {
    if (setting_of(knobs, preset_of(quality)) == setting) return quality;
  }
  return std::nullopt;
}

}  // namespace

Result<TradeScene> read_trade_scene(const std::filesystem::path& scan,
                                    const std::filesystem::path& truth, Progress& progress) {
  RELIEF_TRY_ASSIGN(auto files, TradeFiles::read(scan, progress));
  TradeScene scene{trade_knobs(), std::move(files), {}, TradeTruth::File};
  if (!truth.empty()) {
    RELIEF_TRY_ASSIGN(scene.truth, read_truth(truth, progress));
  } else if (!scene.files.points().triangles.empty()) {
    scene.truth_is = TradeTruth::Faces;
    scene.truth = mesh_of_points(scene.files.points());
  } else {
    scene.truth_is = TradeTruth::FinestPatches;
    RELIEF_TRY_ASSIGN(scene.truth, finest_patches(scene.files, progress));
  }
  return scene;
}

Result<TradeBench> TradeBench::prepare(TradeScene& scene, const ScenePlan& plan,
                                       GlPlatform platform, Progress& progress) {
  const TradeSetting usual = usual_setting(scene.knobs);
  RELIEF_TRY_ASSIGN(
      const TradeFile* const file,
      scene.files.file_of(options_of(scene.knobs, usual, TradeStage::Convert),
                          options_of(scene.knobs, usual, TradeStage::File), progress));
  TradeBench bench(scene, BenchView{plan, plan.views.front(), file->model, platform});
  RELIEF_TRY_ASSIGN(bench.usual_, bench.method_of(usual, *file));
  const RenderSettings& settings = bench.usual_.settings;
  RELIEF_TRY(check_engine(*find_engine(settings.engine), settings, bench.usual_.model));
  RELIEF_TRY_ASSIGN(
      bench.truth_,
      trace_truth(bench.usual_, &scene.truth,
                  look_in(settings.material, CompareNormals::Yes, kTruthRays), progress));
  return bench;
}

Result<BenchMethod> TradeBench::method_of(const TradeSetting& setting,
                                          const TradeFile& file) const {
  OptionValues options = options_of(scene_->knobs, setting, TradeStage::Render);
  const auto engine_name = options.extract("engine");
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine,
                    engine_named(std::get<std::string>(engine_name.mapped())));
  RELIEF_TRY_ASSIGN(auto settings, bench_row(view_, *engine, options));
  return BenchMethod{RenderModel::of(file.model), std::move(settings)};
}

Result<const TradeFile*> TradeBench::file_of(const TradeSetting& setting, Progress& progress) {
  return scene_->files.file_of(options_of(scene_->knobs, setting, TradeStage::Convert),
                               options_of(scene_->knobs, setting, TradeStage::File), progress);
}

Status TradeBench::measure(const std::vector<TradeSetting>& settings, const TradeRounds& rounds,
                           Progress& progress) {
  std::vector<BenchMethod> methods;
  std::vector<std::size_t> places;
  for (const TradeSetting& setting : settings) {
    const auto file = file_of(setting, progress);
    if (progress.cancelled()) return interrupted_error();
    if (!file) continue;  // too coarse or too fine for this scan
    RELIEF_TRY_ASSIGN(auto method, method_of(setting, **file));
    if (!check_engine(*find_engine(method.settings.engine), method.settings, method.model))
      continue;
    methods.push_back(std::move(method));
    places.push_back(rows_.size());
    TradeRow row;
    row.setting = setting;
    row.name = name_of(scene_->knobs, setting);
    row.quality = quality_of(scene_->knobs, setting);
    row.file = (*file)->cost;
    rows_.push_back(std::move(row));
  }
  if (methods.empty()) return {};
  const Look look = look_in(usual_.settings.material, CompareNormals::Yes, kTruthRays);
  RELIEF_TRY_ASSIGN(const auto compared, compare_rows(methods, truth_, look, progress));
  for (std::size_t k = 0; k < places.size(); ++k)
    rows_[places[k]].accuracy = accuracy_of(compared[k]);
  return time(methods, places, rounds, progress);
}

Status TradeBench::time_again(const std::vector<std::size_t>& rows, const TradeRounds& rounds,
                              Progress& progress) {
  std::vector<BenchMethod> methods;
  for (const std::size_t row : rows) {
    RELIEF_TRY_ASSIGN(const TradeFile* const file, file_of(rows_[row].setting, progress));
    RELIEF_TRY_ASSIGN(auto method, method_of(rows_[row].setting, *file));
    methods.push_back(std::move(method));
  }
  return time(methods, rows, rounds, progress);
}

Status TradeBench::time(const std::vector<BenchMethod>& methods,
                        const std::vector<std::size_t>& rows, const TradeRounds& rounds,
                        Progress& progress) {
  std::vector<BenchMethod> pictures = methods;
  pictures.push_back(usual_);
  RELIEF_TRY_ASSIGN(const auto report, time_pictures(pictures, rounds, progress));
  const double usual_ms = report.rows.back().time.frame_ms;
  renderer_ = report.renderer;
  usual_ms_.push_back(usual_ms);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    TradeRow& row = rows_[rows[k]];
    row.time_ratio = report.rows[k].time.frame_ms / usual_ms;
    row.frames = report.rows[k].time.frames;
    row.gpu_bytes = report.rows[k].gpu_bytes;
  }
  const double scale_ms = median_of(usual_ms_);
  for (TradeRow& row : rows_) row.frame_ms = row.time_ratio * scale_ms;
  return {};
}

}  // namespace relief::cli
