// From points with normals to the regions that become patches.
#pragma once

#include "preprocess/partition.h"

namespace relief {

/// The regions of a scan's first `count` points, with those after them as what is around. Left out
/// are clouds of outliers, and pieces too small to be a surface. Normals are unit; a cone of 0
/// degrees is the default's. Empty or in part if the user interrupts.
[[nodiscard]] std::vector<Region> find_regions(const Points& points, std::size_t count,
                                               const NeighbourGraph& graph,
                                               const LocalFrames& frames, double cone_degrees,
                                               Progress& progress);

}  // namespace relief
