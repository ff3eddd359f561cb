// Which meshes are taken from their triangles.
#include "common/mesh/sharp_mesh.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "common/mesh/coarse_mesh.h"
#include "common/mesh/creases.h"
#include "common/mesh/weld.h"
#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

/// A cube of `side` by `side` squares a face, two units wide each. Points on its edges are repeated
/// for each face.
Points dense_cube(std::uint32_t side) {
  Points mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
          glm::dvec3 p(0.0);
          p[axis] = sign * side;
          p[(axis + 1) % 3] = sign * (2.0 * i - side);
          p[(axis + 2) % 3] = 2.0 * j - side;
          mesh.positions.push_back(p);
          if (i == side || j == side) continue;
          const std::uint32_t k = first + j * (side + 1) + i;
          mesh.triangles.push_back({k, k + 1, k + side + 2});
          mesh.triangles.push_back({k, k + side + 2, k + side + 1});
        }
      }
    }
  }
  return mesh;
}

/// The same, with one point a position, each moved by up to `most` along each axis.
Points noisy_cube(std::uint32_t side, double most) {
  Points mesh = dense_cube(side);
  mesh.triangles = welded_triangles(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> move(-most, most);
  for (glm::dvec3& p : mesh.positions) p += glm::dvec3(move(random), move(random), move(random));
  return mesh;
}

Points dense_sphere(std::uint32_t side) {
  Points mesh = dense_cube(side);
  for (glm::dvec3& p : mesh.positions) p = glm::normalize(p);
  return mesh;
}

TEST(WeldedTriangles, HaveTheFirstPointOfEachPosition) {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 9, 4}};
  const std::vector<Triangle> welded = welded_triangles(mesh);
  EXPECT_EQ(welded[1], (Triangle{1, 5, 2}));
  EXPECT_EQ(welded[2], (Triangle{0, 9, 2})) << "a corner that is no point stays";
}

TEST(CreaseCensus, CountsTheEdgesOfACube) {
  Points cube = dense_cube(10);
  cube.triangles = welded_triangles(cube);
  const CreaseCensus census = count_creases(cube);
  EXPECT_EQ(census.edges, 3U * cube.triangles.size() / 2U);
  EXPECT_EQ(census.creases, 120U);
  EXPECT_EQ(census.ends_in_lines, 240U - 24U) << "three creases meet in each of eight corners";
}

TEST(CreaseCensus, IsTheSameWhicheverWayTrianglesFace) {
  Points cube = dense_cube(10);
  cube.triangles = welded_triangles(cube);
  for (std::size_t t = 0; t < cube.triangles.size(); t += 3)
    std::swap(cube.triangles[t][0], cube.triangles[t][1]);
  EXPECT_EQ(count_creases(cube).creases, 120U);
}

TEST(SharpMesh, HasCreasesThatAreLines) {
  const Points cube = dense_cube(40);
  EXPECT_FALSE(is_coarse_mesh(cube));
  EXPECT_TRUE(is_sharp_mesh(cube));
  EXPECT_TRUE(is_designed_mesh(cube));
  EXPECT_FALSE(is_sharp_mesh(dense_sphere(40)));
  EXPECT_FALSE(is_sharp_mesh(Points{}));
}

// Noise of a third of an edge: creases everywhere.
TEST(SharpMesh, IsNoneWithNoise) {
  EXPECT_FALSE(is_sharp_mesh(noisy_cube(40, 0.6)));
  EXPECT_TRUE(is_sharp_mesh(noisy_cube(40, 0.04))) << "noise of rounding";
}

TEST(SharpMesh, DoesNotMindTrianglesThatAReaderWouldDrop) {
  Points cube = dense_cube(40);
  cube.triangles.push_back({0, 1, 1'000'000});
  cube.positions.emplace_back(NAN, 0, 0);
  cube.triangles.push_back({0, 1, static_cast<std::uint32_t>(cube.positions.size() - 1)});
  EXPECT_TRUE(is_sharp_mesh(cube));
  cube.triangles = {{0, 1, 1'000'000}};
  EXPECT_FALSE(is_sharp_mesh(cube));
}

TEST(DesignedMesh, IsCoarseOrSharp) {
  EXPECT_TRUE(is_designed_mesh(test::cube()));
  EXPECT_FALSE(is_designed_mesh(dense_sphere(40)));
}

}  // namespace
}  // namespace relief
