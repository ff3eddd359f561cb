// Bodies as design programs write them: few points, triangles as large as faces.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "common/points.h"

namespace relief::test {

/// From -1 to 1. Its faces are halved along diagonals that leave some corners five triangles and
/// others four.
inline Points cube() {
  Points points;
  for (int k = 0; k < 8; ++k) {
    points.positions.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1,
                                  (k & 4) != 0 ? 1 : -1);
  }
  const auto face = [&points](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    points.triangles.push_back({a, b, c});
    points.triangles.push_back({a, c, d});
  };
  face(0, 2, 3, 1);
  face(4, 5, 7, 6);
  face(0, 1, 5, 4);
  face(2, 6, 7, 3);
  face(0, 4, 6, 2);
  face(1, 3, 7, 5);
  return points;
}

/// A ring about the z axis, from 0 to `height`: radii 1 and 2, `sides` flat strips about each.
inline Points ring(std::uint32_t sides, double height) {
  Points points;
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double a = 2.0 * std::numbers::pi * k / sides;
    for (const auto& [radius, z] : {std::pair(1.0, 0.0), {1.0, height}, {2.0, height}, {2.0, 0.0}})
      points.positions.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
  }
  // From each corner of the section to the next, about the axis.
  for (std::uint32_t k = 0; k < sides; ++k) {
    for (std::uint32_t c = 0; c < 4; ++c) {
      const std::uint32_t here = 4 * k + c;
      const std::uint32_t next = 4 * k + (c + 1) % 4;
      const std::uint32_t step = 4 * ((k + 1) % sides) - 4 * k;
      points.triangles.push_back({here, next, next + step});
      points.triangles.push_back({here, next + step, here + step});
    }
  }
  return points;
}

}  // namespace relief::test
