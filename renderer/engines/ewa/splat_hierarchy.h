// Coarser point sets of a cloud, for progressive rendering ([Zwicker 2001], section 8).
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/geometry/splat_cloud.h"
#include "renderer/view/view.h"

namespace relief::ewa {

/// A cloud and coarser versions of it.
struct SplatHierarchy {
  std::vector<SplatCloud> levels;  ///< the cloud itself first, each next one coarser
};

/// Clusters the points of each level in the cells of a grid, an octree's, whose side doubles from
/// level to level and is two median radii at the first. Points of a cell whose normals lie in
/// different octants, such as the two sides of a sheet, stay apart. A cluster has its points' mean
/// position, normal and colour, weighted by the area h^2 that each stands for; patch, grid
/// coordinates and material of the point nearest to its middle; and a radius that keeps the area
/// and reaches over all of its points. Ends when a level has few points or no longer shrinks.
[[nodiscard]] SplatHierarchy build_hierarchy(SplatCloud cloud);

/// The coarsest level whose points' radii are at most `pixels` in the mean over those before the
/// eye; 0 if none is.
[[nodiscard]] std::size_t level_of_size(const SplatHierarchy& hierarchy, const View& view,
                                        double pixels);

}  // namespace relief::ewa
