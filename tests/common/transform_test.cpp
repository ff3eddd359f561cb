// Transforming models changes only their frames; joining them keeps every patch.
#include "common/transform.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

glm::dvec3 node(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  const double h = patch.at(i, j) == kHole ? 0.0 : patch.at(i, j) * patch.height_step;
  return patch.origin + patch.axes * glm::dvec3(i * patch.spacing, j * patch.spacing, h);
}

// Written out again: what it is measured by must not be what is tested.
glm::dvec3 expected_position(const Transform& t, glm::dvec3 p) {
  return t.translation + t.scale * (t.rotation * p);
}

const Transform kAnywhere{{-1e6, 20.0, 3.0}, rotation_about({1.0, 2.0, -0.5}, 77.0), 1.7};

/// A model of one patch and no size but its bounding sphere.
PatchModel ball(glm::dvec3 centre, double radius) {
  PatchModel model;
  model.patches.push_back(test::bumpy_patch({}));
  model.bounds = {centre - radius, centre + radius};
  model.bounding_radius = radius;
  model.spacing = 0.25;
  return model;
}

TEST(Rotation, TurnsCounterClockwiseAboutItsAxis) {
  const glm::dmat3 turn = rotation_about({0.0, 0.0, 3.0}, 90.0);
  // Doubles: cos 90 degrees is 6e-17.
  EXPECT_LT(glm::distance(turn * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-15);
  EXPECT_LT(glm::distance(turn * glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0)), 1e-15);
  EXPECT_EQ(turn * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1));
}

TEST(TransformModel, MovesEveryNode) {
  const PatchModel before = test::bumpy_model(5, 1);
  PatchModel after = before;
  ASSERT_TRUE(transform_model(after, kAnywhere));
  for (std::size_t p = 0; p < before.patches.size(); ++p) {
    const Patch& patch = before.patches[p];
    EXPECT_EQ(after.patches[p].heights, patch.heights);
    EXPECT_EQ(after.patches[p].normals.texels, patch.normals.texels);
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        // Coordinates up to 1e7, where doubles are 2e-9 apart; a dozen roundings.
        EXPECT_LT(glm::distance(node(after.patches[p], i, j),
                                expected_position(kAnywhere, node(patch, i, j))),
                  1e-7);
      }
    }
  }
  EXPECT_DOUBLE_EQ(after.spacing, 1.7 * before.spacing);
  EXPECT_DOUBLE_EQ(after.bounding_radius, 1.7 * before.bounding_radius);
}

TEST(TransformModel, BoundsKeepTheirMiddleAndHoldTheTurnedBoxOrSphere) {
  PatchModel model;
  model.bounds = {{-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}};
  model.bounding_radius = 2.5;  // an ellipsoid, say
  ASSERT_TRUE(transform_model(model, {{10, 0, 0}, rotation_about({0, 0, 1}, 90.0), 2.0}));
  // Turned about z, x and y change places: half sides 2, 1, 3, doubled; z is cut by the sphere.
  EXPECT_LT(glm::distance(model.bounds.min, glm::dvec3(10 - 4, -2, -5)), 1e-12);
  EXPECT_LT(glm::distance(model.bounds.max, glm::dvec3(10 + 4, 2, 5)), 1e-12);
}

TEST(TransformModel, RefusesWhatNumbersCannotSay) {
  PatchModel model = test::bumpy_model(1);
  model.patches[0].spacing = 1e35;  // as a hostile patch file may say
  EXPECT_FALSE(transform_model(model, {{}, glm::dmat3(1.0), 1e9}));
  model = test::bumpy_model(1);
  model.patches[0].height_step = 1e-35;
  EXPECT_FALSE(transform_model(model, {{}, glm::dmat3(1.0), 1e-9}));
  model = test::bumpy_model(1);
  model.bounds.max.x = std::numeric_limits<double>::max();
  EXPECT_FALSE(transform_model(model, {{}, glm::dmat3(1.0), 10.0}));
}

TEST(AppendModel, PatchesCountOnAndBoundsHoldBoth) {
  PatchModel all = ball({0, 0, 0}, 1.0);
  PatchModel other = ball({10, 0, 0}, 1.0);
  other.patches[0].origin = {1, 2, 3};
  other.spacing = 0.1;
  other.has_colours = true;
  append_model(all, other);
  ASSERT_EQ(all.patches.size(), 2U);
  EXPECT_EQ(all.patches[1].origin, glm::dvec3(1, 2, 3));
  EXPECT_EQ(all.bounds.min, glm::dvec3(-1, -1, -1));
  EXPECT_EQ(all.bounds.max, glm::dvec3(11, 1, 1));
  EXPECT_DOUBLE_EQ(all.bounding_radius, 6.0);  // about (5, 0, 0); the box's own would be 6.16
  EXPECT_EQ(all.spacing, 0.1);
  EXPECT_TRUE(all.has_colours);
}

TEST(AppendModel, TheSphereIsNoLargerThanTheBoxes) {
  PatchModel all = ball({0, 0, 0}, 1.0);
  PatchModel tall = ball({0, 0, 0}, 3.0);
  tall.bounds = {{-1, -1, -1}, {1, 1, 1}};
  append_model(all, tall);
  EXPECT_DOUBLE_EQ(all.bounding_radius, std::sqrt(3.0));
}

TEST(AppendModel, ModelsWithoutPatchesAddNothing) {
  PatchModel all;
  append_model(all, ball({0, 0, 0}, 1.0));
  EXPECT_EQ(all.bounding_radius, 1.0);
  append_model(all, PatchModel{});
  EXPECT_EQ(all.patches.size(), 1U);
  EXPECT_EQ(all.bounds.max, glm::dvec3(1.0));
}

TEST(AppendModel, ModelsWithoutPatchesHaveBoundsTogether) {
  // As of scans that an engine draws as they are: cameras look at all of them.
  PatchModel all;
  PatchModel one = ball({0, 0, 0}, 1.0);
  PatchModel other = ball({10, 0, 0}, 2.0);
  one.patches.clear();
  other.patches.clear();
  append_model(all, one);
  append_model(all, other);
  EXPECT_EQ(all.bounds.min, glm::dvec3(-1, -2, -2));
  EXPECT_EQ(all.bounds.max, glm::dvec3(12, 2, 2));
}

TEST(AddInstance, HasTheBoundsOfModelsThatWereMovedAndAppended) {
  PatchModel model = ball({1, 2, 3}, 0.5);
  model.is_closed = true;
  const PatchModel extent = without_patches(model);
  PatchModel placed;
  placed.patches = model.patches;
  PatchModel appended;
  for (const double x : {0.0, 4.0, -7.0}) {
    const Transform there{{x, 1.0, 0.0}, rotation_about({0, 1, 1}, 30.0 + x), 1.5};
    ASSERT_TRUE(add_instance(placed, {0, 1, there, 3}, extent));
    PatchModel copy = model;
    copy.patches[0].material = 3;
    ASSERT_TRUE(transform_model(copy, there));
    append_model(appended, copy);
  }
  EXPECT_EQ(placed.bounds.min, appended.bounds.min);
  EXPECT_EQ(placed.bounds.max, appended.bounds.max);
  EXPECT_EQ(placed.bounding_radius, appended.bounding_radius);
  EXPECT_EQ(placed.spacing, appended.spacing);
  EXPECT_TRUE(appended.is_closed && placed.instances[2].is_closed);
  const PatchModel baked = bake(placed);
  EXPECT_TRUE(baked.is_closed);
  append_model(appended, ball({1, 2, 3}, 0.5));
  EXPECT_FALSE(appended.is_closed);
  ASSERT_EQ(baked.patches.size(), 3U);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_EQ(baked.patches[p].origin, appended.patches[p].origin);
    EXPECT_EQ(baked.patches[p].axes, appended.patches[p].axes);
    EXPECT_EQ(baked.patches[p].spacing, appended.patches[p].spacing);
    EXPECT_EQ(baked.patches[p].material, 3U);
  }
}

TEST(AddInstance, SaysWhatNumbersCannot) {
  PatchModel placed;
  placed.patches = ball({0, 0, 0}, 1.0).patches;
  placed.patches[0].spacing = 1e35;
  const PatchModel extent = without_patches(ball({0, 0, 0}, 1.0));
  EXPECT_FALSE(add_instance(placed, {0, 1, {{}, glm::dmat3(1.0), 1e9}, 0}, extent));
  EXPECT_TRUE(placed.instances.empty());
}

}  // namespace
}  // namespace relief
