// Normals and colours of meshes as files give them.
#include "renderer/geometry/mesh_of_points.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/renderer/meshes.h"

namespace relief {
namespace {

/// A cube from -1 to 1; its sides are halved along diagonals that leave some corners five
/// triangles and others four.
Points cube() {
  Points points;
  for (int k = 0; k < 8; ++k)
    points.positions.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1,
                                  (k & 4) != 0 ? 1 : -1);
  const auto side = [&points](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    points.triangles.push_back({a, b, c});
    points.triangles.push_back({a, c, d});
  };
  side(0, 2, 3, 1);
  side(4, 5, 7, 6);
  side(0, 1, 5, 4);
  side(2, 6, 7, 3);
  side(0, 4, 6, 2);
  side(1, 3, 7, 5);
  return points;
}

TEST(MeshOfPoints, NormalsAreMeansByAngleHoweverTheSidesAreHalved) {
  const Points points = cube();
  const TriangleMesh mesh = mesh_of_points(points);
  ASSERT_EQ(mesh.normals.size(), 8U);
  EXPECT_EQ(mesh.triangles, points.triangles);
  EXPECT_TRUE(mesh.colours.empty());
  for (std::size_t k = 0; k < 8; ++k) {
    const glm::dvec3 outward = glm::normalize(points.positions[k]);
    EXPECT_LT(test::degrees_between(glm::dvec3(mesh.normals[k]), outward), 1e-4) << k;
  }
}

TEST(MeshOfPoints, GivenNormalsStayAndOnlyBadOnesAreReplaced) {
  Points points = cube();
  points.normals.assign(8, glm::vec3(0.0F, 3.0F, 4.0F));
  points.normals[2] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  points.normals[7] = glm::vec3(0.0F);
  const TriangleMesh mesh = mesh_of_points(points);
  EXPECT_LT(glm::distance(mesh.normals[0], glm::vec3(0.0F, 0.6F, 0.8F)), 1e-6F);
  for (const std::size_t k : {2U, 7U}) {
    const glm::dvec3 outward = glm::normalize(points.positions[k]);
    EXPECT_LT(test::degrees_between(glm::dvec3(mesh.normals[k]), outward), 1e-4) << k;
  }
}

TEST(MeshOfPoints, VerticesOfNoTriangleHaveNoNormal) {
  Points points = cube();
  points.positions.emplace_back(9.0, 9.0, 9.0);
  EXPECT_EQ(mesh_of_points(points).normals[8], glm::vec3(0.0F));
}

TEST(MeshOfPoints, ColoursBecomeLinearAndOpaque) {
  Points points = cube();
  points.colours.assign(8, glm::u8vec3(255, 188, 0));
  const TriangleMesh mesh = mesh_of_points(points);
  // IEC 61966-2-1: ((188 / 255 + 0.055) / 1.055) ^ 2.4
  EXPECT_LT(glm::distance(mesh.colours[5], glm::vec4(1.0F, 0.502886F, 0.0F, 1.0F)), 1e-5F);
}

}  // namespace
}  // namespace relief
