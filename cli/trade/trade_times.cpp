#include "cli/trade/trade_times.h"

#include <memory>
#include <utility>

#include "common/median.h"
#include "renderer/engine_registry.h"
#include "renderer/gl/open_gl.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief::cli {
namespace {

/// A picture while it is timed.
struct TimedPicture {
  std::unique_ptr<PreparedModel> prepared;
  RenderSettings settings;
  std::vector<double> frame_ms;
  double seconds = 0.0;
  RenderResult last;
};

Result<std::vector<TimedPicture>> prepare_pictures(const std::vector<BenchMethod>& pictures,
                                                   const std::shared_ptr<const OpenGl>& opengl,
                                                   Progress& progress) {
  const auto environments = std::make_shared<EnvironmentCache>();
  std::vector<TimedPicture> timed;
  for (const BenchMethod& picture : pictures) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(picture.settings.engine));
    RELIEF_TRY_ASSIGN(auto prepared, engine->prepare({.model = picture.model,
                                                      .views = {&picture.settings, 1},
                                                      .opengl = opengl,
                                                      .environments = environments}));
    RenderSettings settings = picture.settings;
    // Each call draws one frame, which finds its targets in memory the next time, and times one.
    settings.frames = 1;
    timed.push_back({std::move(prepared), std::move(settings), {}, 0.0, {}});
    if (progress.cancelled()) return interrupted_error();
  }
  return timed;
}

}  // namespace

Result<TradeTimes> time_pictures(const std::vector<BenchMethod>& pictures,
                                 const TradeRounds& rounds, Progress& progress) {
  RELIEF_TRY_ASSIGN(const auto opengl,
                    OpenGl::create(pictures.front().settings.platform, false, true));
  RELIEF_TRY_ASSIGN(auto timed, prepare_pictures(pictures, opengl, progress));
  for (int round = 0; round < rounds.frames; ++round) {
    for (TimedPicture& picture : timed) {
      if (!picture.frame_ms.empty() && picture.seconds > rounds.seconds) continue;
      RELIEF_TRY_ASSIGN(picture.last, picture.prepared->render(picture.settings, progress));
      if (progress.cancelled()) return interrupted_error();
      picture.frame_ms.push_back(picture.last.frame_ms);
      picture.seconds += 1e-3 * picture.last.frame_ms;
    }
  }
  TradeTimes times;
  for (TimedPicture& picture : timed) {
    BenchRow row;
    row.time.frames = static_cast<int>(picture.frame_ms.size());
    row.time.frame_ms = median_of(picture.frame_ms);
    row.covered_pixels = picture.last.covered_pixels;
    if (needs_opengl(picture.settings.engine) && picture.last.explanation)
      row.gpu_bytes = bound_bytes(*picture.last.explanation).all;
    times.renderer = picture.last.renderer;
    times.rows.push_back(row);
  }
  return times;
}

}  // namespace relief::cli
