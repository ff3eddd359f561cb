// A frame about a normal.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// Computes two unit vectors that complete a unit normal to a right-handed frame (u, v, n).
inline void complete_frame(glm::dvec3 n, glm::dvec3& u, glm::dvec3& v) {
  const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  u = glm::normalize(glm::cross(other, n));
  v = glm::cross(n, u);
}

}  // namespace relief
