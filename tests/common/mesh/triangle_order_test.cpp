// An order of triangles that does not depend on how a file lists them.
#include "common/mesh/triangle_order.h"

#include <gtest/gtest.h>

#include <array>

namespace relief {
namespace {

TEST(TriangleOrder, IsThatOfCornersWhereverATriangleBegins) {
  const std::vector<Triangle> triangles{{4, 2, 3}, {1, 0, 2}, {3, 4, 2}, {2, 0, 3}};
  const TriangleOrder order = order_triangles(triangles, 5);
  EXPECT_EQ(order.triangles, (std::vector<std::uint32_t>{1, 3, 0, 2}));
  EXPECT_EQ(order.ends, (std::vector<std::uint32_t>{2, 2, 4, 4, 4}));
}

TEST(TriangleOrder, IsTheSameOfAMirroredMesh) {
  const std::vector<Triangle> triangles{{0, 3, 1}, {0, 1, 2}, {0, 2, 3}, {1, 3, 2}};
  std::vector<Triangle> mirrored = triangles;
  for (Triangle& t : mirrored) std::swap(t[1], t[2]);
  EXPECT_EQ(order_triangles(triangles, 4).triangles, order_triangles(mirrored, 4).triangles);
}

TEST(TriangleOrder, PutsEqualTrianglesTogether) {
  // The second is the other side of the first and third.
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 1}, {2, 0, 1}};
  EXPECT_EQ(order_triangles(triangles, 3).triangles, (std::vector<std::uint32_t>{0, 2, 1}));
}

TEST(TriangleOrder, LeavesOutWhatItIsTold) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {9, 9, 9}, {1, 2, 3}};
  const std::array<std::uint8_t, 3> left_out{0, 1, 0};
  EXPECT_EQ(order_triangles(triangles, 4, left_out).triangles, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_TRUE(order_triangles({}, 0).triangles.empty());
}

}  // namespace
}  // namespace relief
