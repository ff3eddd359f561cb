#include "preprocess/points/on_mesh/densify.h"

#include <gtest/gtest.h>

#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

// A mesh of the unit square's grid whose cells `big` by `big` in the middle are two triangles.
Points mesh_with_big_triangles(std::uint32_t side, std::uint32_t big) {
  Points points;
  for (std::uint32_t j = 0; j <= side; ++j) {
    for (std::uint32_t i = 0; i <= side; ++i) points.positions.emplace_back(i, j, 0.0);
  }
  const auto node = [&](std::uint32_t i, std::uint32_t j) { return j * (side + 1) + i; };
  const std::uint32_t low = (side - big) / 2;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      if (i >= low && i < low + big && j >= low && j < low + big) continue;
      points.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      points.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  }
  const std::uint32_t high = low + big;
  points.triangles.push_back({node(low, low), node(high, low), node(high, high)});
  points.triangles.push_back({node(low, low), node(high, high), node(low, high)});
  // The vertices within the big cell are not there.
  for (std::uint32_t j = low + 1; j < high; ++j) {
    for (std::uint32_t i = low + 1; i < high; ++i) {
      points.positions[node(i, j)] = glm::dvec3(node(i, j), -1000.0, 0.0);
    }
  }
  return points;
}

double distance_to_nearest(const Points& points, glm::dvec3 position) {
  double nearest = 1e9;
  for (const glm::dvec3& p : points.positions)
    nearest = std::min(nearest, glm::distance(p, position));
  return nearest;
}

TEST(Densify, FillsTrianglesThatAreLargerThanTheSpacing) {
  Points points = mesh_with_big_triangles(20, 6);
  const std::size_t given = points.size();
  const std::size_t added = densify_triangles(points);
  EXPECT_EQ(points.size(), given + added);
  // Every spot of the big cell is within a spacing or so of a point.
  for (double y = 7.5; y < 13.0; y += 0.5) {
    for (double x = 7.5; x < 13.0; x += 0.5) {
      EXPECT_LT(distance_to_nearest(points, {x, y, 0.0}), 1.2) << x << ", " << y;
    }
  }
}

TEST(Densify, DoesNotChangeEvenMeshesAndScans) {
  Points even = mesh_with_big_triangles(20, 1);
  EXPECT_EQ(densify_triangles(even), 0U);
  Points scan = test::sample_sphere(1000);
  EXPECT_EQ(densify_triangles(scan), 0U);
}

TEST(Densify, InterpolatesAttributes) {
  Points points = mesh_with_big_triangles(20, 6);
  for (const glm::dvec3& p : points.positions) {
    points.normals.emplace_back(0, 0, 1);
    points.colours.emplace_back(static_cast<std::uint8_t>(std::clamp(p.x, 0.0, 20.0) * 10.0), 7, 9);
  }
  const std::size_t given = points.size();
  densify_triangles(points);
  ASSERT_EQ(points.normals.size(), points.size());
  ASSERT_EQ(points.colours.size(), points.size());
  for (std::size_t i = given; i < points.size(); ++i) {
    EXPECT_NEAR(points.colours[i].r, points.positions[i].x * 10.0, 1.0);
    EXPECT_EQ(points.colours[i].g, 7);
  }
}

TEST(Densify, FillsEveryTriangleOfAnUnevenMesh) {
  // Most vertices lie in one corner: filling the big triangles at the mean spacing takes more
  // points than were given. None of them may stay empty.
  Points points = mesh_with_big_triangles(20, 1);
  for (glm::dvec3& p : points.positions) p *= 0.05;
  const auto first = static_cast<std::uint32_t>(points.size());
  for (int j = 0; j <= 3; ++j) {
    for (int i = 0; i <= 3; ++i) points.positions.emplace_back(10.0 + 8.0 * i, 8.0 * j, 0.0);
  }
  for (std::uint32_t j = 0; j < 3; ++j) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t k = first + 4 * j + i;
      points.triangles.push_back({k, k + 1, k + 5});
      points.triangles.push_back({k, k + 5, k + 4});
    }
  }
  densify_triangles(points);
  // sqrt(area / points): 577 of area, 457 points.
  for (double y = 1.0; y < 24.0; y += 1.0) {
    for (double x = 11.0; x < 34.0; x += 1.0) {
      EXPECT_LT(distance_to_nearest(points, {x, y, 0.0}), 1.3) << x << ", " << y;
    }
  }
}

TEST(Densify, NeedlesAreBounded) {
  Points points;  // a cube's corner and a far sliver
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e6, 1e6, 1}};
  points.triangles = {{0, 1, 2}, {1, 2, 3}};
  densify_triangles(points);
  EXPECT_LE(points.size(), 20U);  // four per point given
}

TEST(Densify, TrianglesWithoutAreaGetNoPoints) {
  // Long edges and no area: there is no spacing to fill them at.
  Points points;
  for (int i = 0; i < 30; ++i) points.positions.emplace_back(i, i % 2, 0.0);
  points.triangles = {{0, 2, 28}, {1, 3, 29}};
  EXPECT_EQ(densify_triangles(points), 0U);
  // Nor is there one where the area is beyond what doubles hold.
  points.triangles.push_back({0, 1, 2});
  points.positions[1] = {1e200, -1e200, 0.0};
  points.positions[2] = {-1e200, 1e200, 1e200};
  EXPECT_EQ(densify_triangles(points), 0U);
}

}  // namespace
}  // namespace relief
