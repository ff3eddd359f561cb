// From points with normals to the regions that become patches.
#pragma once

#include "preprocess/partition/partition.h"

namespace relief {

struct FindRegionsOptions {
  double cone_degrees = 0.0;  ///< 0: default
  bool keeps_densities_apart = false;
};

/// The regions of a scan's first `count` points, with those after them as what is around. Left out
/// are clouds of outliers, and pieces too small to be a surface. Normals are unit. In part if the
/// user interrupts.
[[nodiscard]] std::vector<Region> find_regions(const Points& points, std::size_t count,
                                               const NeighbourGraph& graph,
                                               const LocalFrames& frames,
                                               const FindRegionsOptions& options,
                                               Progress& progress);

}  // namespace relief
