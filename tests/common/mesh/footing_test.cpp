// Whether meshes stand, and with which axis up.
#include "common/mesh/footing.h"

#include <gtest/gtest.h>

#include <array>

namespace relief {
namespace {

/// Adds a box between two corners.
void add_box(Points& mesh, glm::dvec3 low, glm::dvec3 high) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int k = 0; k < 8; ++k)
    mesh.positions.emplace_back((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                                (k & 4) != 0 ? high.z : low.z);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& s : kSides) {
    mesh.triangles.push_back({first + s[0], first + s[1], first + s[2]});
    mesh.triangles.push_back({first + s[0], first + s[2], first + s[3]});
  }
}

/// A figure on a base, with something in its hand toward -Y, so that it could not lie.
Points statue() {
  Points mesh;
  add_box(mesh, {-1.0, -1.0, 0.0}, {1.0, 1.0, 0.5});
  add_box(mesh, {-0.4, -0.3, 0.5}, {0.4, 0.3, 5.0});
  add_box(mesh, {-0.1, -2.0, 4.0}, {0.1, -0.3, 4.2});
  return mesh;
}

Points with_y_up(Points mesh) {
  for (glm::dvec3& p : mesh.positions) p = {p.x, p.z, -p.y};
  return mesh;
}

TEST(Footing, IsTheHullOfTheLowestPoints) {
  Points box;
  add_box(box, {0.0, 0.0, 0.0}, {2.0, 1.0, 4.0});
  const Footing footing = footing_of(box, 2);
  EXPECT_NEAR(footing.share, 1.0, 1e-12);
  EXPECT_NEAR(footing.margin, 0.5 / 2.0, 1e-12);  // half its depth over half its height
}

TEST(Footing, IsBelowZeroWhereTheCentreIsBesideIt) {
  Points mesh;
  add_box(mesh, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  add_box(mesh, {0.0, 0.0, 1.0}, {9.0, 1.0, 2.0});
  const Footing footing = footing_of(mesh, 2);
  EXPECT_NEAR(footing.share, 1.0 / 9.0, 1e-12);
  EXPECT_LT(footing.margin, 0.0);
}

TEST(Footing, CountsNoVerticesWithoutTriangles) {
  Points mesh = statue();
  const Footing before = footing_of(mesh, 2);
  mesh.positions.emplace_back(50.0, 50.0, -50.0);
  EXPECT_EQ(footing_of(mesh, 2).share, before.share);
}

TEST(Footing, IsNothingWithoutArea) {
  Points mesh;
  EXPECT_EQ(footing_of(mesh, 1).share, 0.0);
  mesh.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(footing_of(mesh, 1).share, 0.0);
  EXPECT_FALSE(stands_on_z(mesh));
}

TEST(StandsOnZ, IsPlainForAStatue) {
  EXPECT_TRUE(stands_on_z(statue()));
  EXPECT_FALSE(stands_on_z(with_y_up(statue())));
}

// What stands either way, or neither way, is Y up, as meshes usually are.
TEST(StandsOnZ, IsNotForWhatStandsEitherWay) {
  Points mesh;
  add_box(mesh, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  EXPECT_FALSE(stands_on_z(mesh));
}

// A disc upright: it would roll with Y up and lies flat with Z up, but is rather seen from Z.
TEST(StandsOnZ, IsNotForAPlaque) {
  Points mesh = statue();
  for (glm::dvec3& p : mesh.positions) p.z *= 0.1;
  EXPECT_FALSE(stands_on_z(mesh));
}

}  // namespace
}  // namespace relief
