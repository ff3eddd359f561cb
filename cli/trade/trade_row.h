// A setting of `relief bench --trade` and what was measured of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/bench_accuracy.h"
#include "cli/options/quality.h"
#include "cli/trade/trade_knobs.h"

namespace relief::cli {

/// What a patch file costs, and how near it is to the scan.
struct TradeFileCost {
  double convert_seconds = 0.0;  ///< reading, converting, writing
  double load_seconds = 0.0;     ///< opening the file and decoding all of it
  std::uint64_t file_bytes = 0;
  double surface_psnr_db = 0.0;  ///< as `psnr_db` of `relief convert`
  std::uint64_t samples = 0;
  std::uint64_t patches = 0;
};

struct TradeRow {
  TradeSetting setting;
  std::string name;
  std::optional<Quality> quality;  ///< of whose preset it is the setting
  TradeFileCost file;
  PictureAccuracy accuracy;
  /// Over that of the default setting, drawn in turns with it: so rows of different minutes can be
  /// compared on a machine that does other work, too.
  double time_ratio = 1.0;
  double frame_ms = 0.0;  ///< the ratio times the default's median
  int frames = 0;         ///< of which the ratio is
  std::optional<std::uint64_t> gpu_bytes;
};

}  // namespace relief::cli
