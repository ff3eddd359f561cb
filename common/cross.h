// The cross product in the plane.
#pragma once

#include <glm/vec2.hpp>

namespace relief {

/// Returns the area of the parallelogram of two vectors; above 0 if the second lies
/// counterclockwise of the first, by up to half a turn.
[[nodiscard]] inline double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace relief
