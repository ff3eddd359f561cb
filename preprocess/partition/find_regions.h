// Finds the regions of points that become patches.
#pragma once

#include "preprocess/normals/crease_normals.h"
#include "preprocess/partition/partition.h"

namespace relief {

/// Returns the regions of a scan's first `count` points; the points after them are only
/// surroundings. Leaves out clouds of outliers and pieces too small to be a surface. Normals are
/// unit. `cone_degrees` is the largest angle between a region's normal and its points' normals; 0:
/// default. Regions end at `creases`, whatever their cones allow; may be null. Returns fewer
/// regions if the user interrupts.
[[nodiscard]] std::vector<Region> find_regions(const Points& points, std::size_t count,
                                               const NeighbourGraph& graph,
                                               const LocalFrames& frames, double cone_degrees,
                                               const CreaseNormals* creases, Progress& progress);

}  // namespace relief
