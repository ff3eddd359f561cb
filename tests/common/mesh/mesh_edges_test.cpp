// What the edges of small meshes are, counted by hand.
#include "common/mesh/mesh_edges.h"

#include <gtest/gtest.h>

namespace relief {
namespace {

/// A tetrahedron whose faces all run the same way about it.
Points tetrahedron() {
  Points mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

TEST(MeshEdges, ListsTheUsesOfAnEdgeBesideEachOther) {
  const MeshEdges edges(tetrahedron());
  const auto of_first = edges.of(0);
  ASSERT_EQ(of_first.size(), 6U);
  for (std::size_t e = 0; e < 6; e += 2) {
    EXPECT_EQ(of_first[e].greater, 1 + e / 2);
    EXPECT_EQ(of_first[e + 1].greater, of_first[e].greater);
    EXPECT_LT(of_first[e].triangle, of_first[e + 1].triangle);
    EXPECT_NE(of_first[e].forward, of_first[e + 1].forward);
  }
  EXPECT_EQ(edges.of(1).size(), 4U);
  EXPECT_EQ(edges.of(3).size(), 0U);
  EXPECT_TRUE(edges.all_have_two());
  EXPECT_EQ(edges.misoriented(), 0.0);
}

TEST(MeshEdges, CountsThoseThatTwoTrianglesRunThroughAlike) {
  Points turned = tetrahedron();
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  const MeshEdges edges(turned);
  EXPECT_FALSE(edges.all_have_two());
  EXPECT_EQ(edges.misoriented(), 0.5);  // three of six
}

TEST(MeshEdges, FindsBordersAndEdgesOfThreeTriangles) {
  Points open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_FALSE(MeshEdges(open).all_have_two());
  EXPECT_TRUE(MeshEdges(open).has_border());
  EXPECT_FALSE(MeshEdges(tetrahedron()).has_border());
  EXPECT_EQ(MeshEdges(open).misoriented(), 0.0);

  Points fin = tetrahedron();
  fin.positions.emplace_back(1, 1, 1);
  fin.triangles.push_back({0, 1, 4});
  EXPECT_FALSE(MeshEdges(fin).all_have_two());
  EXPECT_TRUE(MeshEdges(fin).has_border());
  Points twice = tetrahedron();
  twice.triangles.push_back(twice.triangles.front());
  EXPECT_FALSE(MeshEdges(twice).all_have_two());
  EXPECT_FALSE(MeshEdges(twice).has_border());
  // The fin runs through its edge against the first triangle there; turned it runs with it.
  EXPECT_EQ(MeshEdges(fin).misoriented(), 0.0);
  std::swap(fin.triangles[4][0], fin.triangles[4][1]);
  EXPECT_EQ(MeshEdges(fin).misoriented(), 1.0 / 7.0);
}

TEST(MeshEdges, HasNoneWithoutTriangles) {
  Points scan = tetrahedron();
  scan.triangles.clear();
  EXPECT_EQ(MeshEdges(scan).misoriented(), 1.0);
}

}  // namespace
}  // namespace relief
