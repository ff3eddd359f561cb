// A box about points, and a sphere.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// An axis-aligned box; empty while min > max.
struct Bounds {
  glm::dvec3 min{1.0};
  glm::dvec3 max{-1.0};
  [[nodiscard]] bool empty() const { return min.x > max.x; }
};

/// Makes the box the smallest that holds it and a point.
void extend(Bounds& box, glm::dvec3 point);

/// The box about some points; empty if there are none.
[[nodiscard]] Bounds bounds_of(const std::vector<glm::dvec3>& positions);

/// The radius of the sphere about the centre of `bounds` that holds all the points.
[[nodiscard]] double bounding_radius(const std::vector<glm::dvec3>& positions,
                                     const Bounds& bounds);

}  // namespace relief
