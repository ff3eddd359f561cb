// Which meshes are coarse.
#include "common/mesh/coarse_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/common/mesh/bodies.h"

namespace relief {
namespace {

/// A flat square of `side` by `side` points.
Points grid(std::uint32_t side) {
  Points mesh;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      mesh.positions.emplace_back(i, j, 0);
      if (i + 1 == side || j + 1 == side) continue;
      const std::uint32_t k = j * side + i;
      mesh.triangles.push_back({k, k + 1, k + side + 1});
      mesh.triangles.push_back({k, k + side + 1, k + side});
    }
  }
  return mesh;
}

TEST(CoarseMesh, IsOfLargeTriangles) {
  EXPECT_TRUE(is_coarse_mesh(test::cube()));
  EXPECT_TRUE(is_coarse_mesh(test::ring(2000, 8.0))) << "8000 points, all on edges";
  EXPECT_FALSE(is_coarse_mesh(grid(80))) << "a scan";
  EXPECT_TRUE(is_coarse_mesh(grid(8))) << "a scan of 64 points is none";
  EXPECT_FALSE(is_coarse_mesh(Points{}));
}

TEST(CoarseMesh, IsATownOfBoxes) {
  // 1,000 boxes: 8,000 points, whose distance is half an edge.
  Points town;
  for (std::uint32_t k = 0; k < 1000; ++k) {
    const Points box = test::cube();
    for (const Triangle& t : box.triangles)
      town.triangles.push_back({t[0] + 8 * k, t[1] + 8 * k, t[2] + 8 * k});
    for (const glm::dvec3& p : box.positions)
      town.positions.push_back(p + glm::dvec3(3.0 * (k % 32), 3.0 * (k / 32), 0.0));
  }
  EXPECT_TRUE(is_coarse_mesh(town));
}

TEST(CoarseMesh, DoesNotMindTrianglesThatAReaderWouldDrop) {
  Points mesh = grid(80);
  mesh.triangles.push_back({0, 1, 6400});
  mesh.positions.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  mesh.triangles.push_back({0, 1, 6400});
  EXPECT_FALSE(is_coarse_mesh(mesh));
}

TEST(CoarseMesh, HasTheAreaOfItsTriangles) {
  EXPECT_EQ(area_of_triangles(test::cube()), 24.0);
  EXPECT_EQ(area_of_triangles(grid(3)), 4.0);
}

}  // namespace
}  // namespace relief
