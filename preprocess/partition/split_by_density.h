// Splits regions whose points are much denser in one place than in another.
#pragma once

#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// Largest ratio of the spacings of a region's sparse and dense part (spacing_range). A much
/// smaller limit would split even scans because of the estimate's noise.
inline constexpr double kWidestDensityRatio = 3.0;

/// Splits each region of a wider ratio into connected pieces of a narrower one, which keep its
/// normal. A patch has one spacing: one that suits the dense part loses what is sparse, and the
/// reverse. Regions of less than two pieces' points stay whole.
[[nodiscard]] std::vector<Region> split_by_density(const SurfaceSamples& samples,
                                                   const NeighbourGraph& graph,
                                                   std::vector<Region> regions);

}  // namespace relief
