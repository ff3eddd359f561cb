// Measures settings of `relief bench --trade`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/bench_rows.h"
#include "cli/trade/trade_files.h"
#include "cli/trade/trade_knobs.h"
#include "cli/trade/trade_row.h"
#include "cli/trade/trade_times.h"
#include "common/error.h"
#include "common/image/image.h"
#include "common/progress.h"
#include "renderer/bench/bench_row.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief::cli {

/// Where the truth is from: another file's faces, those of the input, or patches with as many
/// samples as its points can tell.
enum class TradeTruth : std::uint8_t { File, Faces, FinestPatches };

/// What is drawn, and what it is compared with.
struct TradeScene {
  std::vector<TradeKnob> knobs;
  TradeFiles files;
  TriangleMesh truth;
  TradeTruth truth_is = TradeTruth::Faces;
};

/// Reads the scan, and the truth if `truth` names a file. Fails if that has no faces.
Result<TradeScene> read_trade_scene(const std::filesystem::path& scan,
                                    const std::filesystem::path& truth, Progress& progress);

/// Measures the settings of a scene. The scene outlives it and stays where it is.
class TradeBench {
 public:
  /// Makes the patch file of the default setting and the truth's image of the plan's first view.
  /// The plan outlives the bench.
  static Result<TradeBench> prepare(TradeScene& scene, const ScenePlan& plan, GlPlatform platform,
                                    Progress& progress);

  /// Measures settings and appends their rows. A setting that can't be converted or drawn is left
  /// out. Fails if the user interrupts, or as render_views() does.
  Status measure(const std::vector<TradeSetting>& settings, const TradeRounds& rounds,
                 Progress& progress);

  /// Measures the times of rows again, in turns with the default.
  Status time_again(const std::vector<std::size_t>& rows, const TradeRounds& rounds,
                    Progress& progress);

  [[nodiscard]] const std::vector<TradeRow>& rows() const { return rows_; }
  [[nodiscard]] const RenderSettings& view() const { return usual_.settings; }
  [[nodiscard]] const std::string& renderer() const { return renderer_; }

 private:
  TradeBench(TradeScene& scene, BenchView view) : scene_(&scene), view_(view) {}

  Result<BenchMethod> method_of(const TradeSetting& setting, const TradeFile& file) const;
  Result<const TradeFile*> file_of(const TradeSetting& setting, Progress& progress);
  Status time(const std::vector<BenchMethod>& methods, const std::vector<std::size_t>& rows,
              const TradeRounds& rounds, Progress& progress);

  TradeScene* scene_;
  BenchView view_;
  BenchMethod usual_;
  Image truth_;
  std::string renderer_;
  std::vector<TradeRow> rows_;
  std::vector<double> usual_ms_;  ///< the default's medians, one for each time it was drawn
};

}  // namespace relief::cli
