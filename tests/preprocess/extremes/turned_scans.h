// Scans that are turned or mirrored, and what must become of their patches.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "common/octahedral.h"
#include "common/patch.h"
#include "common/points.h"
#include "tests/preprocess/surfaces.h"

namespace relief::test {

inline const glm::dmat3 kMirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

inline glm::dmat3 turn(double degrees, const glm::dvec3& about) {
  return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), glm::normalize(about)));
}

/// A bent torus, no two of whose directions are alike.
inline Points bent_torus(double spacing = 0.06) {
  Points points = sample_torus({}, spacing);
  points.normals.clear();
  for (glm::dvec3& p : points.positions)
    p = {1.4 * p.x + 0.2 * p.y * p.y, p.y + 0.15 * p.x * p.x, 0.8 * p.z + 0.1 * p.x * p.y};
  return points;
}

/// By a mirror, too, which makes clockwise triangles of counter-clockwise ones.
inline Points turned(Points points, const glm::dmat3& matrix) {
  for (glm::dvec3& p : points.positions) p = matrix * p;
  for (glm::vec3& n : points.normals) n = matrix * glm::dvec3(n);
  if (glm::determinant(matrix) < 0.0) {
    for (Triangle& triangle : points.triangles) std::swap(triangle[0], triangle[2]);
  }
  return points;
}

inline glm::dvec3 normal_of(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  return patch.axes * glm::dvec3(unit_from_snorm16(texel_at(patch.normals, i, j)));
}

/// Node (i, j) of `a` is node (j, i) of `b` where one is mirrored, else (i, j).
inline void expect_turned(const Patch& a, const Patch& b, const glm::dmat3& matrix) {
  const bool is_mirrored = glm::determinant(matrix) < 0.0;
  ASSERT_EQ(a.width, is_mirrored ? b.height : b.width);
  ASSERT_EQ(a.height, is_mirrored ? b.width : b.height);
  EXPECT_NEAR(glm::determinant(b.axes), 1.0, 1e-12);
  EXPECT_EQ(a.normals.scale, b.normals.scale);
  for (std::uint32_t row = 0; row < a.height; ++row) {
    for (std::uint32_t column = 0; column < a.width; ++column) {
      const std::uint32_t i = is_mirrored ? row : column;
      const std::uint32_t j = is_mirrored ? column : row;
      ASSERT_EQ(a.at(column, row) == kHole, b.at(i, j) == kHole);
      if (a.at(column, row) == kHole) continue;
      const double off = glm::distance(matrix * position_of(a, column, row), position_of(b, i, j));
      ASSERT_LE(off, 1.001 * a.height_step);
      // Steps of 16-bit normals are 3e-5.
      ASSERT_LE(glm::distance(matrix * normal_of(a, column, row), normal_of(b, i, j)), 1e-4);
      if (!a.colours.empty()) {
        ASSERT_EQ(texel_at(a.colours, column, row), texel_at(b.colours, i, j));
      }
      for (std::size_t k = 0; k < a.scalars.size(); ++k)
        ASSERT_EQ(texel_at(a.scalars[k], column, row), texel_at(b.scalars[k], i, j));
    }
  }
}

/// Every sample is where it was before the turn, but for the last step of its height.
inline void expect_turned(const PatchModel& before, const PatchModel& after,
                          const glm::dmat3& matrix) {
  ASSERT_EQ(before.patches.size(), after.patches.size());
  for (std::size_t p = 0; p < before.patches.size(); ++p)
    expect_turned(before.patches[p], after.patches[p], matrix);
}

}  // namespace relief::test
