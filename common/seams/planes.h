// Where planes meet.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// A plane through a position; unit normal.
struct Plane {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};

  [[nodiscard]] double above(glm::dvec3 from) const { return glm::dot(position - from, normal); }
};

/// Half-way between two planes that face one side.
[[nodiscard]] inline Plane mean(const Plane& a, const Plane& b) {
  return {0.5 * (a.position + b.position), glm::normalize(a.normal + b.normal)};
}

/// The way from a position to the nearest one on both planes. Not finite if they are parallel.
[[nodiscard]] inline glm::dvec3 to_crease(const Plane& a, const Plane& b, glm::dvec3 from) {
  const double cosine = glm::dot(a.normal, b.normal);
  const double to_a = a.above(from) - cosine * b.above(from);
  const double to_b = b.above(from) - cosine * a.above(from);
  return (to_a * a.normal + to_b * b.normal) / (1.0 - cosine * cosine);
}

/// The volume that the normals of three planes span: 1 at a cube's corner, 0 if they have a line or
/// a direction in common.
[[nodiscard]] inline double volume_of(const Plane& a, const Plane& b, const Plane& c) {
  return glm::dot(a.normal, glm::cross(b.normal, c.normal));
}

/// The way from a position to the one on three planes. Not finite if their volume is 0.
[[nodiscard]] inline glm::dvec3 to_corner(const Plane& a, const Plane& b, const Plane& c,
                                          glm::dvec3 from) {
  return (a.above(from) * glm::cross(b.normal, c.normal) +
          b.above(from) * glm::cross(c.normal, a.normal) +
          c.above(from) * glm::cross(a.normal, b.normal)) /
         volume_of(a, b, c);
}

}  // namespace relief
