// The exposures of HDR-FLIP.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "common/compare/flip.h"
#include "common/compare/tone_mapping.h"

namespace relief {

Exposures find_exposures(const LinearColour& reference) {
  constexpr double kShown = 0.85;
  // The published tool's lower limit of the median, which is 0 for a model on black. Here it also
  // limits the brightest pixel: a black reference then has one exposure, at which any light is
  // visible.
  constexpr double kDarkest = std::numeric_limits<float>::epsilon();
  std::vector<float> luminances(reference.rgb[0].size());
  for (std::size_t k = 0; k < luminances.size(); ++k) {
    // Halved, so that no sum of large floats overflows; doubled again in double.
    luminances[k] = 0.5F * (0.2126F * reference.rgb[0][k] + 0.7152F * reference.rgb[1][k] +
                            0.0722F * reference.rgb[2][k]);
  }
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double median = std::max(2.0 * *middle, kDarkest);
  const double brightest =
      std::max(2.0 * *std::max_element(luminances.begin(), luminances.end()), median);
  const double light = light_shown_as(kShown);
  Exposures exposures;
  exposures.start = std::log2(light / brightest);
  exposures.stop = std::log2(light / median);
  const double stops = exposures.stop - exposures.start;
  // Two equal exposures add nothing to one.
  if (stops > 0.0) exposures.count = std::max(2, static_cast<int>(std::ceil(stops)));
  return exposures;
}

}  // namespace relief
