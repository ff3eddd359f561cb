#include "renderer/engines/raytrace/meet_triangle.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace relief::raytrace {

std::optional<Hit> meet_triangle(std::uint32_t number, const std::array<glm::dvec3, 3>& corners,
                                 glm::dvec3 direction) {
  const glm::dvec3 size = glm::abs(direction);
  const glm::length_t z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const glm::length_t x = (z + 1) % 3;
  const glm::length_t y = (z + 2) % 3;
  const double lean_x = direction[x] / direction[z];
  const double lean_y = direction[y] / direction[z];
  std::array<glm::dvec2, 3> flat;
  for (std::size_t k = 0; k < 3; ++k) {
    flat[k] = {corners[k][x] - lean_x * corners[k][z], corners[k][y] - lean_y * corners[k][z]};
  }
  glm::dvec3 areas;
  bool left = true;
  bool right = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2& from = flat[(k + 1) % 3];
    const glm::dvec2& to = flat[(k + 2) % 3];
    const double one = from.x * to.y;
    const double other = from.y * to.x;
    left = left && one >= other;
    right = right && one <= other;
    areas[static_cast<glm::length_t>(k)] = std::abs(one - other);
  }
  if (!left && !right) return std::nullopt;
  const double area = areas.x + areas.y + areas.z;
  if (!(area > 0.0)) return std::nullopt;
  const glm::dvec3 weights = areas / area;
  const double depth =
      glm::dot(weights, glm::dvec3(corners[0][z], corners[1][z], corners[2][z])) / direction[z];
  if (!(depth > 0.0)) return std::nullopt;
  return Hit{number, depth, weights};
}

}  // namespace relief::raytrace
