// Chooses each patch's spacing for scans of varying density.
#pragma once

#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// Returns whether the density of a scan varies so much that its patches' spacing follows it: if
/// the sparse part's spacing is 2.5 times the dense one's (spacing_range). Regions of few points do
/// not count: outliers are sparse, too.
[[nodiscard]] bool is_uneven(const SurfaceSamples& samples, const std::vector<Region>& regions);

/// Returns the spacing of each region's patch in spacings of the model: the median of its points'
/// local spacings over the median of all points, at least that of the densest twentieth of the
/// scan. Sparse regions that are rough or have few points get less.
[[nodiscard]] std::vector<double> spacing_factors(const SurfaceSamples& samples,
                                                  const std::vector<Region>& regions);

}  // namespace relief
