// Normals of vertices from the triangles around them.
#include "common/mesh/mesh_normals.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

/// Whether a normal is that of a cube's corner, within float's rounding.
bool faces_outward(glm::vec3 normal, glm::dvec3 corner) {
  return glm::dot(glm::dvec3(normal), glm::normalize(corner)) > 1.0 - 1e-6;
}

TEST(VertexNormals, AreMeansByAngleHoweverTheSidesAreHalved) {
  const Points mesh = test::cube();
  const std::vector<glm::vec3> normals = vertex_normals(mesh);
  ASSERT_EQ(normals.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_TRUE(faces_outward(normals[k], mesh.positions[k]));
}

TEST(VertexNormals, StayAndOnlyBadOnesAreReplaced) {
  Points mesh = test::cube();
  mesh.normals.assign(8, glm::vec3(0.0F, 3.0F, 4.0F));
  mesh.normals[2] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  mesh.normals[7] = glm::vec3(0.0F);
  const std::vector<glm::vec3> normals = vertex_normals(mesh);
  EXPECT_LT(glm::distance(normals[0], glm::vec3(0.0F, 0.6F, 0.8F)), 1e-6F);
  for (const std::size_t k : {2U, 7U}) EXPECT_TRUE(faces_outward(normals[k], mesh.positions[k]));
}

}  // namespace
}  // namespace relief
