// Points spread over meshes of few.
#include "preprocess/points/on_mesh/spread_on_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/mesh/creases.h"
#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

Points with_normals(Points mesh) {
  split_at_creases(mesh);
  return mesh;
}

TEST(SpreadOnMesh, LiesOnTheTrianglesThatItNames) {
  const Points mesh = with_normals(test::ring(24, 1.0));
  const SpreadPoints spread = spread_on_mesh(mesh, 4000);
  ASSERT_EQ(spread.triangles.size(), spread.points.size());
  for (std::size_t i = 0; i < spread.points.size(); ++i) {
    const Triangle& t = mesh.triangles[spread.triangles[i]];
    const glm::dvec3 a = mesh.positions[t[0]];
    const glm::dvec3 across = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    EXPECT_LT(std::abs(glm::dot(spread.points.positions[i] - a, glm::normalize(across))), 1e-12);
    EXPECT_NEAR(glm::length(spread.points.normals[i]), 1.0F, 1e-6F);
  }
}

TEST(SpreadOnMesh, IsEvenHoweverTheTrianglesAre) {
  // A cube from -1 to 1 has an area of 24. The ring's strips are needles, 0.013 by 8.
  const double step = std::sqrt(24.0 / 2400.0);
  const SpreadPoints on_cube = spread_on_mesh(with_normals(test::cube()), 2400);
  EXPECT_GT(on_cube.points.size(), 2000U);
  EXPECT_LT(on_cube.points.size(), 4000U);
  const std::vector<glm::dvec3>& p = on_cube.points.positions;
  for (std::size_t i = 0; i < p.size(); ++i) {
    double nearest = 10.0;
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (k != i) nearest = std::min(nearest, glm::distance(p[i], p[k]));
    }
    EXPECT_GE(nearest, 0.6 * step - 1e-12);
    EXPECT_LE(nearest, 1.2 * step);
  }
  const SpreadPoints on_ring = spread_on_mesh(with_normals(test::ring(500, 8.0)), 10'000);
  EXPECT_GT(on_ring.points.size(), 8000U);
  EXPECT_LT(on_ring.points.size(), 20'000U);
}

TEST(SpreadOnMesh, KeepsEdgesAndBothSidesOfAThinWall) {
  Points plate = test::cube();
  for (glm::dvec3& p : plate.positions) p.z *= 0.001;
  const SpreadPoints spread = spread_on_mesh(with_normals(plate), 2000);
  std::size_t above = 0;
  std::size_t below = 0;
  std::size_t on_edge = 0;
  for (std::size_t i = 0; i < spread.points.size(); ++i) {
    const glm::dvec3 p = spread.points.positions[i];
    const float z = spread.points.normals[i].z;
    above += z > 0.5F ? 1 : 0;
    below += z < -0.5F ? 1 : 0;
    on_edge += std::max(std::abs(p.x), std::abs(p.y)) == 1.0 ? 1 : 0;
  }
  EXPECT_GT(above, 800U);
  EXPECT_GT(below, 800U);
  EXPECT_GT(on_edge, 100U);  // 8 long, two spacings of 0.063 at most
}

TEST(SpreadOnMesh, InterpolatesWhatCornersHave) {
  Points mesh = with_normals(test::cube());
  for (const glm::dvec3& p : mesh.positions) mesh.colours.emplace_back(p.x > 0.0 ? 200 : 0, 0, 0);
  mesh.scalars.push_back({.name = "height", .values = {}});
  for (const glm::dvec3& p : mesh.positions) mesh.scalars[0].values.push_back(p.z);
  const Points points = spread_on_mesh(mesh, 500).points;
  ASSERT_EQ(points.colours.size(), points.size());
  ASSERT_EQ(points.scalars[0].values.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points.scalars[0].values[i], points.positions[i].z, 1e-12);
    EXPECT_NEAR(points.colours[i].x, 100.0 * (points.positions[i].x + 1.0), 1.0);
  }
}

TEST(SpreadOnMesh, IsEmptyWithoutAnArea) {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.normals.assign(3, glm::vec3(0, 0, 1));
  EXPECT_EQ(spread_on_mesh(mesh, 100).points.size(), 0U);
}

}  // namespace
}  // namespace relief
