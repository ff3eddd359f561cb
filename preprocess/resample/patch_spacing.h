// How far apart the samples of each patch are, where the scan's density differs.
#pragma once

#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// The coarsest patch's spacing over the finest one's, at most.
inline constexpr double kWidestSpacingRatio = 8.0;
/// In one region, the spacing that a tenth of the points exceed over the one that a tenth fall
/// below, at most. Much less would part even scans for the noise of the estimate.
inline constexpr double kWidestDensityRatio = 3.0;

/// The spacing of each region's patch in spacings of the model: the median of its points' local
/// spacings over the median of all, from that of the densest twentieth of the scan to eight times
/// it.
[[nodiscard]] std::vector<double> spacing_factors(const SurfaceSamples& samples,
                                                  const std::vector<Region>& regions);

}  // namespace relief
