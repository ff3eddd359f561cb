// Sizes of surfels that cover their Voronoi cells.
#pragma once

#include <glm/vec3.hpp>
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
/// Positions are finite and distinct; 2 or more. The result does not depend on the number of
/// threads. Fails only if it is interrupted.
Result<std::vector<double>> find_cell_sizes(const std::vector<glm::dvec3>& positions,
                                            Progress& progress);

}  // namespace relief
