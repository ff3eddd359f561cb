// Sides of small pieces of a large scan, window by window.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/normals/known_sides.h"

namespace relief {

/// Chooses the sides again where large pieces were too coarse for it: one body among many on a
/// ground has few of them. `normals`: with sides that are right for the most part. `number`: the
/// winding number that places on the surface should have.
///
/// Cuts the points into smaller pieces and these into blocks. Where the winding numbers of a block
/// are not as they should be, the sides of the block and its surroundings are chosen together, with
/// all other pieces as they are, and kept if their energy is lower. The result does not depend on
/// the number of threads. Incomplete if the user interrupts.
void refine_sides(const Points& points, const NeighbourGraph& graph, const KnownSides& known,
                  float number, std::vector<glm::vec3>& normals, const Progress& progress);

/// Whether there are so many points that it is worth it.
[[nodiscard]] bool are_sides_coarse(std::size_t points);

}  // namespace relief
