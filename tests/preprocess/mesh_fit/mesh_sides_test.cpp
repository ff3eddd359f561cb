// Neighbours on the sides of a mesh.
#include "preprocess/mesh_fit/mesh_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relief {
namespace {

TEST(MeshSides, OfFewPointsAreTaken) {
  MeshSides sides;
  sides.of_points.assign(17, 4);
  sides.of_points.insert(sides.of_points.end(), 16, 7);
  sides.of_triangles = {4, 7, 9};
  const std::vector<std::uint8_t> dropped = take_small_sides(sides);
  EXPECT_EQ(std::ranges::count(dropped, 1), 16);
  EXPECT_EQ(dropped[16], 0);
  EXPECT_EQ(sides.of_triangles, (std::vector<std::uint32_t>{4, kAnySide, kAnySide}));
}

TEST(MeshSides, NeighboursAreOfTheSameSide) {
  // Two walls of 20 by 20 points that are a tenth of their points' distance apart.
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> sides;
  for (std::uint32_t k = 0; k < 800; ++k) {
    positions.emplace_back(k / 2 % 20, k / 40, k % 2 == 0 ? 0.0 : 0.1);
    sides.push_back(k % 2);
  }
  const NeighbourGraph graph = find_neighbours_on_sides(positions, sides);
  ASSERT_EQ(graph.k, kSurfaceNeighbours);
  for (std::uint32_t i = 0; i < 800; ++i) {
    for (const std::uint32_t j : graph.of(i)) EXPECT_EQ(i % 2, j % 2);
    EXPECT_GT(graph.spacing[i], 0.8F);
    EXPECT_LT(graph.spacing[i], 1.7F) << "at a corner";
  }
}

TEST(MeshSides, AreAsWideAsAStripAndAsTheRadiusOfADisc) {
  // Three sides: a strip of 40 by 2, of two rows of cells; a disc; a closed body.
  Points mesh;
  std::vector<std::uint32_t> sides;
  for (std::uint32_t i = 0; i <= 40; ++i) {
    for (const double y : {0.0, 1.0, 2.0}) mesh.positions.emplace_back(i, y, 0.0);
  }
  for (std::uint32_t i = 0; i < 40; ++i) {
    for (std::uint32_t j = 0; j < 2; ++j) {
      const std::uint32_t at = 3 * i + j;
      mesh.triangles.push_back({at, at + 3, at + 4});
      mesh.triangles.push_back({at, at + 4, at + 1});
    }
  }
  sides.assign(mesh.triangles.size(), 5);
  const auto middle = static_cast<std::uint32_t>(mesh.size());
  mesh.positions.emplace_back(100.0, 0.0, 0.0);
  for (std::uint32_t k = 0; k < 64; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 64;
    mesh.positions.emplace_back(100.0 + 3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0);
    mesh.triangles.push_back({middle, middle + 1 + k, middle + 1 + (k + 1) % 64});
    sides.push_back(7);
  }
  const auto corner = static_cast<std::uint32_t>(mesh.size());
  for (const glm::dvec3 p : {glm::dvec3(200, 0, 0), {201, 0, 0}, {200, 1, 0}, {200, 0, 1}})
    mesh.positions.push_back(p);
  for (const Triangle t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    mesh.triangles.push_back({corner + t[0], corner + t[1], corner + t[2]});
    sides.push_back(9);
  }
  const auto widths = widths_of_sides(mesh, sides);
  EXPECT_NEAR(widths.at(5), 2.0 * 80.0 / 84.0, 1e-12);
  EXPECT_NEAR(widths.at(7), 3.0, 0.01);
  EXPECT_FALSE(widths.contains(9));
}

}  // namespace
}  // namespace relief
