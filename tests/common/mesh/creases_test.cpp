// Sides of meshes, and normals that end at creases.
#include "common/mesh/creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

std::size_t count_sides(const Points& mesh) {
  const std::vector<std::uint32_t> sides = sides_of_triangles(mesh);
  return std::set(sides.begin(), sides.end()).size();
}

TEST(Creases, PartTheSidesOfABody) {
  EXPECT_EQ(count_sides(test::cube()), 6U);
  EXPECT_EQ(count_sides(test::ring(10, 1.0)), 4U) << "36 degrees from strip to strip";
  EXPECT_EQ(count_sides(test::ring(8, 1.0)), 18U) << "45 degrees";
}

TEST(Creases, ThatEndWithinASurfacePartNothing) {
  // Four triangles about a point; the edge to the first corner is sharp, the others are not.
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0.5}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  EXPECT_EQ(count_sides(mesh), 1U);
}

TEST(Creases, AreWhereTrianglesFaceOppositeSides) {
  Points mesh = test::cube();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_EQ(count_sides(mesh), 7U);
}

TEST(Creases, RepeatPointsForEachSideWithAllThatTheyHave) {
  Points mesh = test::cube();
  const Points whole = mesh;
  for (std::uint8_t k = 0; k < 8; ++k) mesh.colours.emplace_back(k, 0, 0);
  mesh.scalars.push_back({.name = "number", .values = {0, 1, 2, 3, 4, 5, 6, 7}});
  split_at_creases(mesh);
  ASSERT_EQ(mesh.size(), 24U);
  ASSERT_EQ(mesh.normals.size(), 24U);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t now = mesh.triangles[t][c];
      const std::uint32_t before = whole.triangles[t][c];
      EXPECT_EQ(mesh.positions[now], whole.positions[before]);
      EXPECT_EQ(mesh.colours[now].x, before);
      EXPECT_EQ(mesh.scalars[0].values[now], before);
      // The normal is that of one of the three faces: the one all of whose points are at 1 or -1.
      const glm::vec3 normal = mesh.normals[now];
      EXPECT_EQ(std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}), 1.0F);
      EXPECT_GT(glm::dot(glm::dvec3(normal), mesh.positions[now]), 0.99);
    }
  }
}

TEST(Creases, LeaveRoundPartsSmooth) {
  Points mesh = test::ring(24, 1.0);
  split_at_creases(mesh);
  ASSERT_EQ(mesh.size(), 2U * 96U) << "two sides at each point";
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const glm::dvec3 radial = glm::normalize(glm::dvec3(glm::dvec2(mesh.positions[i]), 0.0));
    const double along = std::abs(glm::dot(glm::dvec3(mesh.normals[i]), radial));
    // A strip has two triangles, one of them at two angles of a point: not quite the mean.
    EXPECT_TRUE(along < 1e-6 || along > std::cos(glm::radians(7.5))) << i << ' ' << along;
  }
}

TEST(Creases, LeaveLargeFacesPlaneBesideABevel) {
  // A face of 10 by 10, and a bevel of 10 by 0.1 that turns by 30 degrees.
  Points mesh;
  mesh.positions = {{0, 0, 0},  {10, 0, 0},         {10, 10, 0},
                    {0, 10, 0}, {10.087, 0, -0.05}, {10.087, 10, -0.05}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  split_at_creases(mesh);
  ASSERT_EQ(mesh.size(), 6U) << "no crease";
  for (const std::size_t i : {1U, 2U})
    EXPECT_GT(mesh.normals[i].z, std::cos(glm::radians(2.0))) << "15 if both sides weighed alike";
}

}  // namespace
}  // namespace relief
