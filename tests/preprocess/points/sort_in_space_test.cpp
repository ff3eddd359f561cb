// Points of a scan in the order in which they lie in space.
#include "preprocess/points/sort_in_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/preprocess/shuffled.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

/// A mesh whose every attribute tells which point or triangle it is of.
Points told_apart() {
  Points mesh = test::square_mesh({12, 9}, 0.1, [](double x, double y) { return x * x + y; });
  PointScalar& number = mesh.scalars.emplace_back();
  for (const glm::dvec3& p : mesh.positions) {
    const auto own = static_cast<float>(p.x + 100.0 * p.y);
    mesh.normals.emplace_back(own, 1.0F, 0.0F);
    mesh.colours.emplace_back(10.0 * p.x, 20.0 * p.y, 7);
    mesh.texcoords.emplace_back(own, 2.0F);
    mesh.scanner_of.push_back(static_cast<std::uint16_t>(10.0 * own));
    number.values.push_back(own);
  }
  for (const Triangle& t : mesh.triangles) {
    const auto own = static_cast<float>(mesh.positions[t[0]].x + 100.0 * mesh.positions[t[0]].y);
    mesh.corner_texcoords.push_back({glm::vec2(own), glm::vec2(1.0F), glm::vec2(2.0F)});
    mesh.corner_tangents.push_back({glm::vec4(own), glm::vec4(1.0F), glm::vec4(2.0F)});
    mesh.triangle_materials.push_back(static_cast<std::uint32_t>(10.0F * own));
  }
  return mesh;
}

TEST(SortInSpace, EachPointAndTriangleKeepsItsAttributes) {
  Points mesh = test::shuffled(told_apart(), 1);
  sort_in_space(mesh);
  ASSERT_EQ(mesh.size(), told_apart().size());
  ASSERT_EQ(mesh.triangles.size(), told_apart().triangles.size());
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const glm::dvec3& p = mesh.positions[i];
    const auto own = static_cast<float>(p.x + 100.0 * p.y);
    EXPECT_EQ(mesh.normals[i].x, own);
    EXPECT_EQ(mesh.colours[i], glm::u8vec3(10.0 * p.x, 20.0 * p.y, 7));
    EXPECT_EQ(mesh.texcoords[i].x, own);
    EXPECT_EQ(mesh.scanner_of[i], static_cast<std::uint16_t>(10.0 * own));
    EXPECT_EQ(mesh.scalars.front().values[i], own);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::dvec3& p = mesh.positions[mesh.triangles[t][0]];
    const auto own = static_cast<float>(p.x + 100.0 * p.y);
    EXPECT_EQ(mesh.corner_texcoords[t][0].x, own);
    EXPECT_EQ(mesh.corner_tangents[t][0].x, own);
    EXPECT_EQ(mesh.triangle_materials[t], static_cast<std::uint32_t>(10.0F * own));
  }
}

TEST(SortInSpace, TheFilesOrderDoesNotMatter) {
  Points first = told_apart();
  sort_in_space(first);
  for (const unsigned seed : {1U, 2U}) {
    Points other = test::shuffled(told_apart(), seed);
    sort_in_space(other);
    EXPECT_EQ(other.positions, first.positions) << seed;
    EXPECT_EQ(other.triangles, first.triangles) << seed;
    EXPECT_EQ(other.triangle_materials, first.triangle_materials) << seed;
  }
}

TEST(SortInSpace, NoPointsAreSortedToo) {
  Points none;
  sort_in_space(none);
  EXPECT_EQ(none.size(), 0U);
}

}  // namespace
}  // namespace relief
