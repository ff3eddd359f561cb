// Normals that change at creases at once.
#pragma once

#include <cstdint>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"

namespace relief {

struct CreaseNormals {
  /// The points' own, and at creases that of the side on which a point is.
  std::vector<glm::vec3> normals;
  std::vector<std::uint8_t> at_crease;  ///< of each point, 1 if it is near a crease
};

/// Finds creases: points whose neighbours show two sides, between which normals turn sharply.
/// Points on a crease have a mean of both sides' normals; they are given one side's, so that a
/// partition may end there, and fits of a side may tell its points. `given`: unit.
[[nodiscard]] CreaseNormals find_creases(const std::vector<glm::dvec3>& positions,
                                         const std::vector<glm::vec3>& given,
                                         const NeighbourGraph& graph);

}  // namespace relief
