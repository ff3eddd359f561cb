// Sizes of surfels that cover their Voronoi cells.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// Finds for each point twice the distance to the farthest corner of its Voronoi cell among its 16
/// nearest neighbours, in the plane through them: the circumscribed circle's radius of the largest
/// triangle that has the point as a corner. Discs of that size leave no gap in a plane, and none
/// that is smaller would do. A cell ends at the distance of its eighth neighbour: at borders it has
/// no end.
///
/// Normals are for discs that clip lines cut at sharp edges, so that they may reach over these:
/// with them neighbours of the point's own surface alone make its cell, and those beyond an edge
/// bound it where they lie. Where another surface is so much denser that few of the 16 are its own,
/// its own among the nearest 128 count (docs/decisions/0133).
///
/// Positions are finite and distinct; 2 or more. Normals: of length 1; empty: cells are those of
/// positions alone. The result does not depend on the number of threads. Fails only if it is
/// interrupted.
Result<std::vector<double>> find_cell_sizes(const std::vector<glm::dvec3>& positions,
                                            std::span<const glm::vec3> normals, Progress& progress);

}  // namespace relief
