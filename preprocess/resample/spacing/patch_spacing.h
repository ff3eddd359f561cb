// Chooses each patch's spacing for scans of varying density.
#pragma once

#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// Largest ratio of the coarsest patch's spacing to the finest one's.
inline constexpr double kWidestSpacingRatio = 8.0;

/// Returns the spacing of each region's patch in spacings of the model: the median of its points'
/// local spacings over the median of all points, limited to between that of the densest twentieth
/// of the scan and eight times it.
[[nodiscard]] std::vector<double> spacing_factors(const SurfaceSamples& samples,
                                                  const std::vector<Region>& regions);

}  // namespace relief
