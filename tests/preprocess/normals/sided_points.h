// Points with the side that each of them has: what orientation is held against.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "common/points.h"

namespace relief::test {

struct SidedPoints {
  Points points;
  std::vector<glm::vec3> sides;  ///< unit

  void add(glm::dvec3 position, glm::dvec3 side) {
    points.positions.push_back(position);
    sides.emplace_back(side);
  }

  /// A sphere that faces outward, as evenly covered as by sunflower seeds.
  void add_sphere(glm::dvec3 centre, double radius, double spacing) {
    const int count =
        static_cast<int>(4.0 * std::numbers::pi * radius * radius / (spacing * spacing));
    for (int i = 0; i < count; ++i) {
      const double z = 1.0 - 2.0 * (i + 0.5) / count;
      const double turn = std::numbers::pi * (1.0 + std::sqrt(5.0)) * i;
      const double r = std::sqrt(1.0 - z * z);
      const glm::dvec3 side(r * std::cos(turn), r * std::sin(turn), z);
      add(centre + radius * side, side);
    }
  }

  /// The share of points whose normals face away from their sides.
  [[nodiscard]] double flipped(const std::vector<glm::vec3>& normals) const {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < normals.size(); ++i)
      wrong += glm::dot(normals[i], sides[i]) < 0.0F ? 1 : 0;
    return static_cast<double>(wrong) / static_cast<double>(normals.size());
  }
};

}  // namespace relief::test
