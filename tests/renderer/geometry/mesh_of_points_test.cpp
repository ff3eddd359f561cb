// Normals and colours of meshes as files give them.
#include "renderer/geometry/meshes/mesh_of_points.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

TEST(MeshOfPoints, CoarseMeshesHaveCreases) {
  const Points points = test::cube();
  const TriangleMesh mesh = mesh_of_points(points);
  ASSERT_EQ(mesh.normals.size(), 24U);
  ASSERT_EQ(mesh.triangles.size(), points.triangles.size());
  EXPECT_TRUE(mesh.colours.empty());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(mesh.positions[corners[c]], points.positions[points.triangles[t][c]]);
    EXPECT_EQ(mesh.normals[corners[0]], mesh.normals[corners[1]]);
    EXPECT_EQ(mesh.normals[corners[0]], mesh.normals[corners[2]]);
  }
}

TEST(MeshOfPoints, GivenNormalsStaySmooth) {
  Points points = test::cube();
  points.normals.assign(8, glm::vec3(0.0F, 3.0F, 4.0F));
  const TriangleMesh mesh = mesh_of_points(points);
  ASSERT_EQ(mesh.normals.size(), 8U);
  EXPECT_EQ(mesh.triangles, points.triangles);
  EXPECT_LT(glm::distance(mesh.normals[0], glm::vec3(0.0F, 0.6F, 0.8F)), 1e-6F);
}

TEST(MeshOfPoints, VerticesOfNoTriangleHaveNoNormal) {
  Points points = test::cube();
  points.positions.emplace_back(9.0, 9.0, 9.0);
  EXPECT_EQ(mesh_of_points(points).normals[8], glm::vec3(0.0F));
}

TEST(MeshOfPoints, ColoursBecomeLinearAndOpaque) {
  Points points = test::cube();
  points.colours.assign(8, glm::u8vec3(255, 188, 0));
  const TriangleMesh mesh = mesh_of_points(points);
  // IEC 61966-2-1: ((188 / 255 + 0.055) / 1.055) ^ 2.4
  EXPECT_LT(glm::distance(mesh.colours[5], glm::vec4(1.0F, 0.502886F, 0.0F, 1.0F)), 1e-5F);
}

}  // namespace
}  // namespace relief
