// Normals and distances beyond the borders of patches that meet.
#include "common/seams/join_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "common/octahedral.h"
#include "common/seams/make_seams.h"
#include "common/seams/seam_distances.h"

namespace relief {
namespace {

/// A flat patch of 6 x 6 nodes, of which the last column is a hole, turned about the y axis.
Patch tilted_patch(glm::dvec3 origin, double degrees, bool hole_first) {
  const double a = glm::radians(degrees);
  Patch patch;
  patch.origin = origin;
  patch.axes = {{std::cos(a), 0, -std::sin(a)}, {0, 1, 0}, {std::sin(a), 0, std::cos(a)}};
  patch.height_step = 0.05;
  patch.width = 6;
  patch.height = 6;
  for (std::uint32_t k = 0; k < 36; ++k)
    patch.heights.push_back(k % 6 == (hole_first ? 0U : 5U) ? kHole : 0);
  patch.normals = {6, 6, 1, std::vector<glm::i16vec2>(36, snorm16_from_unit({0, 0, 1}))};
  return patch;
}

/// Two patches side by side, the second tilted. Their samples end at x = 4 and begin about x = 5.
PatchModel two_patches(double degrees) {
  const double a = glm::radians(degrees);
  PatchModel model;
  model.patches.push_back(tilted_patch({0, 0, 0}, 0.0, false));
  model.patches.push_back(tilted_patch({5.0 - std::cos(a), 0, std::sin(a)}, degrees, true));
  model.joined = {{0, 2}};
  return model;
}

glm::vec3 normal_beyond_first(const PatchModel& model) {
  return unit_from_snorm16(model.patches[0].normals.texels[3 * 6 + 5]);
}

TEST(JoinNormals, LeansTowardTheNeighbour) {
  PatchModel model = two_patches(20.0);
  join_normals(model);
  const glm::vec3 beyond = normal_beyond_first(model);
  // Between the own normal and the neighbour's, nearer to that: its samples lie there.
  const double degrees = glm::degrees(std::atan2(beyond.x, beyond.z));
  EXPECT_GT(degrees, 10.0);
  EXPECT_LT(degrees, 20.0);
  // Samples keep theirs.
  for (std::uint32_t j = 0; j < 6; ++j)
    EXPECT_EQ(model.patches[0].normals.texels[j * 6 + 4], snorm16_from_unit({0, 0, 1}));
}

TEST(JoinNormals, KeepsTheOwnNormalAtACrease) {
  PatchModel model = two_patches(60.0);
  join_normals(model);
  EXPECT_EQ(normal_beyond_first(model), unit_from_snorm16(snorm16_from_unit({0, 0, 1})));
}

TEST(JoinNormals, TurnOverACreaseThatIsShadedOver) {
  PatchModel model = two_patches(80.0);
  // As beside a crease of a mesh with one normal a vertex: both turn by 15 degrees.
  const float turn = glm::radians(15.0F);
  for (std::size_t j = 0; j < 6; ++j) {
    model.patches[0].normals.texels[j * 6 + 4] =
        snorm16_from_unit({std::sin(turn), 0.0F, std::cos(turn)});
    model.patches[1].normals.texels[j * 6 + 1] =
        snorm16_from_unit({-std::sin(turn), 0.0F, std::cos(turn)});
  }
  join_normals(model);
  const glm::vec3 beyond = normal_beyond_first(model);
  // Between the own normal and the neighbour's.
  const double degrees = glm::degrees(std::atan2(beyond.x, beyond.z));
  EXPECT_GT(degrees, 25.0);
  EXPECT_LT(degrees, 65.0);
}

TEST(JoinNormals, LeavesOverlappingPatchesAlone) {
  PatchModel model = two_patches(20.0);
  model.joined.clear();
  const std::vector<glm::i16vec2> before = model.patches[0].normals.texels;
  join_normals(model);
  EXPECT_EQ(model.patches[0].normals.texels, before);
}

TEST(SeamDistances, AreThoseToTheNearestTriangle) {
  const PatchModel model = two_patches(0.0);
  const SeamDistances distances(model.patches, make_seams(model.patches));
  EXPECT_NEAR(*distances.find({4.5, 2.2, 0.3}), 0.3, 1e-12);   // over the seam
  EXPECT_NEAR(*distances.find({3.6, 2.2, 0.3}), 0.5, 1e-12);   // 0.4 beside it
  EXPECT_NEAR(*distances.find({4.5, -0.4, 0.3}), 0.5, 1e-12);  // beyond its end
  EXPECT_FALSE(distances.find({4.5, 2.2, 7.0}));
}

}  // namespace
}  // namespace relief
