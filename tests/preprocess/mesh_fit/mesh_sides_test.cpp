// Neighbours on the sides of a mesh.
#include "preprocess/mesh_fit/mesh_sides.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace relief
