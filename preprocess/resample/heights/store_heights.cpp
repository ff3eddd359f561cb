#include "preprocess/resample/heights/store_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief {

double store_heights(std::span<const double> heights, double step, Patch& patch) {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (std::size_t n = 0; n < heights.size(); ++n) {
    if (patch.heights[n] == kHole) continue;
    lowest = std::min(lowest, heights[n]);
    highest = std::max(highest, heights[n]);
  }
  patch.height_step = std::max(step, (highest - lowest) / kMaxHeightRange);
  for (std::size_t n = 0; n < heights.size(); ++n) {
    if (patch.heights[n] == kHole) continue;
    patch.heights[n] =
        static_cast<std::int32_t>(std::lround((heights[n] - lowest) / patch.height_step));
  }
  return lowest;
}

}  // namespace relief
