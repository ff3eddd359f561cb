// Bounding boxes and spheres of points.
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

/// Grows the box to hold a point.
void extend(Bounds& box, glm::dvec3 point);

/// Returns the bounding box of some points; empty without points.
[[nodiscard]] Bounds bounds_of(const std::vector<glm::dvec3>& positions);

/// Returns the radius of the smallest sphere about the centre of `bounds` that holds all points.
[[nodiscard]] double bounding_radius(const std::vector<glm::dvec3>& positions,
                                     const Bounds& bounds);

}  // namespace relief
