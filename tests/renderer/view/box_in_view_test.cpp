#include "renderer/view/box_in_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "common/transform.h"

namespace relief {
namespace {

/// From the origin along -z; the image shows as much at depth 1 as `slope` on each side.
View ahead(double slope) {
  Camera camera;
  camera.eye = {0.0, 0.0, 0.0};
  camera.target = {0.0, 0.0, -1.0};
  camera.up = {0.0, 1.0, 0.0};
  camera.vertical_fov_degrees = glm::degrees(2.0 * std::atan(slope));
  return make_view(camera, 100, 100, 0.01);
}

PlacedBox box_from(glm::dvec3 min, glm::dvec3 max) {
  return {{min, max}, Transform()};
}

TEST(BoxInView, IsSeenWithinTheImage) {
  const View view = ahead(0.5);
  EXPECT_TRUE(sees_box(view, box_from({-1, -1, -6}, {1, 1, -5}), 0.0));
  EXPECT_TRUE(sees_box(view, box_from({-1, -1, -1}, {1, 1, 1}), 0.0)) << "about the eye";
  EXPECT_FALSE(sees_box(view, box_from({-1, -1, 1}, {1, 1, 2}), 0.0)) << "behind";
  // At a depth of 6 the image shows 3 to each side.
  EXPECT_TRUE(sees_box(view, box_from({2.9, -1, -6}, {9, 1, -5}), 0.0));
  EXPECT_FALSE(sees_box(view, box_from({3.1, -1, -6}, {9, 1, -5}), 0.0));
  EXPECT_FALSE(sees_box(view, box_from({-9, -1, -6}, {-3.1, 1, -5}), 0.0));
  EXPECT_FALSE(sees_box(view, box_from({-1, 3.1, -6}, {1, 9, -5}), 0.0));
  EXPECT_FALSE(sees_box(view, box_from({-1, -9, -6}, {1, -3.1, -5}), 0.0));
}

/// The sphere about a long box reaches into the image, the box does not.
TEST(BoxInView, IsNotItsSphere) {
  const PlacedBox beside = box_from({3.1, -5, -6}, {3.2, 5, -5});
  EXPECT_TRUE(sees_sphere(ahead(0.5), {3.15, 0, -5.5}, 5.0));
  EXPECT_FALSE(sees_box(ahead(0.5), beside, 0.0));
}

TEST(BoxInView, ReachesFartherByItsReach) {
  const View view = ahead(0.5);
  EXPECT_FALSE(sees_box(view, box_from({-1, -1, 1}, {1, 1, 2}), 0.9));
  EXPECT_TRUE(sees_box(view, box_from({-1, -1, 1}, {1, 1, 2}), 1.1));
  // 0.1 beside the image at a depth of 6 is 0.1 cos(atan(0.5)) from the plane through the eye.
  EXPECT_FALSE(sees_box(view, box_from({3.1, -1, -6}, {9, 1, -5}), 0.089));
  EXPECT_TRUE(sees_box(view, box_from({3.1, -1, -6}, {9, 1, -5}), 0.090));
}

TEST(BoxInView, IsAsNearAsItsFrontOrAsTheImageShowsIt) {
  const View view = ahead(0.5);
  EXPECT_DOUBLE_EQ(nearest_depth(view, box_from({-1, -1, -6}, {1, 1, -5})), 5.0);
  EXPECT_LT(nearest_depth(view, box_from({-1, -1, -6}, {1, 1, 5})), 1e-12) << "about the eye";
  // Ground 1 below the eye comes into the image at a depth of 2, in its corners at sqrt(2 / 3).
  const double depth = nearest_depth(view, box_from({-9, -2, -9}, {9, -1, 9}));
  EXPECT_NEAR(depth, std::sqrt(2.0 / 3.0), 1e-12);
}

TEST(BoxInView, OrthographicIsAsNearAsItsFront) {
  View view = ahead(0.5);
  view.orthographic = true;
  EXPECT_DOUBLE_EQ(nearest_depth(view, box_from({-9, -2, -9}, {9, -1, 9})), -9.0);
  EXPECT_TRUE(sees_box(view, box_from({0.4, -1, -60}, {9, 1, -5}), 0.0));
  EXPECT_FALSE(sees_box(view, box_from({0.6, -1, -60}, {9, 1, -5}), 0.0));
}

/// No point of a box that lies in the image is missed, and none is nearer.
TEST(BoxInView, HoldsForPointsOfAnyBox) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto any = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  std::size_t in_image = 0;
  std::size_t unseen = 0;
  for (int round = 0; round < 2000; ++round) {
    Camera camera;
    camera.eye = 2.0 * any();
    camera.target = camera.eye + any();
    camera.up = any();
    if (round % 2 == 0) camera.orthographic_height = 2.0;
    View view = make_view(camera, 150, 100, 0.01);
    if (round % 3 == 0) view = view_of_part(view, {100, 20, 50, 30, 2});
    PlacedBox placed;
    extend(placed.box, 2.0 * any());
    extend(placed.box, placed.box.min + glm::abs(any()));
    placed.transform = {any(), rotation_about(any(), 180.0 * unit(random)), 1.5 + unit(random)};
    const double nearest = nearest_depth(view, placed);
    const bool is_seen = sees_box(view, placed, 0.0);
    unseen += is_seen ? 0 : 1;
    for (int k = 0; k < 50; ++k) {
      const auto& [min, max] = placed.box;
      const glm::dvec3 p =
          moved(placed.transform, glm::mix(min, max, 0.5 * (any() + glm::dvec3(1.0))));
      if (!sees_sphere(view, p, 0.0)) continue;
      ++in_image;
      EXPECT_TRUE(is_seen);
      EXPECT_GE(nearest_depth(view, p, 0.0), nearest - 1e-12);
    }
  }
  EXPECT_GT(in_image, 5000U);
  EXPECT_GT(unseen, 500U);
}

}  // namespace
}  // namespace relief
