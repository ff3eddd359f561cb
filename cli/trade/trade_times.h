// Times pictures as `relief render` makes them, with all their samples a pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/bench/bench_row.h"

namespace relief::cli {

struct TradeTimes {
  std::string renderer;  ///< of the last picture
  /// Parallel to the pictures; of BenchRow's counts only `gpu_bytes`, those of all buffers and
  /// textures of a frame.
  std::vector<BenchRow> rows;
};

/// How long pictures are timed: so many frames each, but no more once they took so long in all, as
/// some engines take seconds a frame. At least one.
struct TradeRounds {
  int frames = 5;
  double seconds = 1.0;
};

/// Draws frame k of each picture before frame k + 1 of any. The first frame of each is not timed.
/// (bench() has one sample a pixel.) Pictures have the same platform. Fails as render_views() does.
Result<TradeTimes> time_pictures(const std::vector<BenchMethod>& pictures,
                                 const TradeRounds& rounds, Progress& progress);

}  // namespace relief::cli
