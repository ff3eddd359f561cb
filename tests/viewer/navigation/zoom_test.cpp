// Zoom, and the projections.
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "ball.h"
#include "viewer/navigation/limits.h"
#include "viewer/navigation/move.h"

namespace relief {
namespace {

const glm::dvec2 kCursor{750, 330};

class Zoom : public testing::TestWithParam<bool> {
 protected:
  Zoom() : navigator(navigator_about(kBall)) { navigator.set_orthographic(GetParam()); }

  void step(double steps) {
    navigator.zoom(steps, kCursor, pick(kBall, navigator.camera(), kCursor));
  }

  Navigator navigator;
};

INSTANTIATE_TEST_SUITE_P(Projections, Zoom, testing::Bool(), [](const auto& test) {
  return test.param ? "Orthographic" : "Perspective";
});

TEST_P(Zoom, KeepsThePointUnderTheCursorAtItsPixel) {
  const auto under = pick(kBall, navigator.camera(), kCursor);
  ASSERT_TRUE(under);
  for (const double steps : {1.0, 0.05, 2.5, -0.3, 4.0, -9.0}) {
    navigator.zoom(steps, kCursor, under);
    EXPECT_LT(glm::distance(*project(navigator.camera(), *under, kSize), kCursor), kSamePixel);
  }
}

TEST_P(Zoom, StepsAreAFactorAndAddUp) {
  const auto under = pick(kBall, navigator.camera(), kCursor);
  const auto size_at = [&] {
    return image_height_at(navigator.camera(), depth_of(navigator.camera(), *under));
  };
  const double before = size_at();
  for (int i = 0; i < 10; ++i) navigator.zoom(0.3, kCursor, under);
  EXPECT_NEAR(size_at(), before * std::pow(kZoomStep, -3.0), 1e-8 * before);
  navigator.zoom(zoom_steps(2.0), kCursor, under);
  EXPECT_NEAR(size_at(), 0.5 * before * std::pow(kZoomStep, -3.0), 1e-8 * before);
}

TEST_P(Zoom, InAndOutAgainIsTheSameCamera) {
  for (const auto& under :
       {pick(kBall, navigator.camera(), kCursor), std::optional<glm::dvec3>()}) {
    const Camera first = navigator.camera();
    const double distance = glm::distance(first.eye, kUtm);
    for (int i = 0; i < 25; ++i) navigator.zoom(0.7, kCursor, under);
    for (int i = 0; i < 25; ++i) navigator.zoom(-0.7, kCursor, under);
    EXPECT_LT(glm::distance(navigator.camera().eye, first.eye), 1e-9 * distance);
    EXPECT_LT(glm::distance(right_of(navigator.camera()), right_of(first)), 1e-9);
    EXPECT_LT(glm::distance(backward_of(navigator.camera()), backward_of(first)), 1e-9);
    EXPECT_NEAR(navigator.camera().orthographic_height, first.orthographic_height, 1e-9 * distance);
  }
}

TEST_P(Zoom, InEndsBeforeTheSurfaceWithOneSampleAcrossTheImage) {
  const glm::dvec3 under = *pick(kBall, navigator.camera(), kCursor);
  for (int i = 0; i < 300; ++i) {
    step(1.0);
    ASSERT_GT(glm::distance(navigator.camera().eye, kUtm), kBall.radius);
  }
  const double depth = depth_of(navigator.camera(), under);
  const double width = image_height_at(navigator.camera(), depth) * kSize.x / kSize.y;
  // Picked points are rounded to 1e-9 of a width of 0.1, and add up over the steps.
  EXPECT_NEAR(width, kBall.spacing, 1e-6);
  const Camera nearest = navigator.camera();
  step(5.0);
  EXPECT_LT(glm::distance(navigator.camera().eye, nearest.eye), 1e-8);
  step(1e6);
  EXPECT_LT(glm::distance(navigator.camera().eye, nearest.eye), 1e-8);
}

TEST_P(Zoom, OutEndsFarFromTheModel) {
  for (int i = 0; i < 300; ++i) step(-1.0);
  const Camera& camera = navigator.camera();
  EXPECT_NEAR(image_height_at(camera, glm::distance(camera.eye, kUtm)),
              kFarthestRadii * kBall.radius, 1e-6 * kBall.radius);
  const Camera farthest = camera;
  step(-1e6);
  EXPECT_LT(glm::distance(navigator.camera().eye, farthest.eye), 1e-6);
  step(1.0);
  EXPECT_GT(shift_between(farthest, navigator.camera(), kBall), 1e-3) << "and comes back";
}

TEST_P(Zoom, OfADragIsThatOfTheWheel) {
  const auto under = pick(kBall, navigator.camera(), kCursor);
  const auto size_at = [&](const Camera& camera) {
    return image_height_at(camera, depth_of(camera, *under));
  };
  const Camera first = navigator.camera();
  navigator.begin(DragKind::Zoom, kCursor, under);
  navigator.drag(kCursor - glm::dvec2(0, 100));
  const Camera nearer = navigator.camera();
  EXPECT_LT(glm::distance(*project(nearer, *under, kSize), kCursor), kSamePixel);
  // An image's height is ten times as large, to the three digits of its constant.
  EXPECT_NEAR(size_at(nearer) / size_at(first), std::pow(10.0, -100.0 / kSize.y), 1e-3);
  navigator.drag(kCursor);
  EXPECT_NEAR(size_at(navigator.camera()), size_at(first), 1e-8);
}

TEST(Limits, HoldBesideTheModel) {
  Navigator navigator = navigator_about(kBall);
  navigator.set_orthographic(true);
  navigator.zoom(20.0, {640, 400}, std::nullopt);
  for (int i = 0; i < 50; ++i) navigator.zoom(-2.0, {0.0, -1e5}, std::nullopt);
  EXPECT_LE(glm::distance(navigator.camera().eye, kUtm), kFarthestRadii * kBall.radius + 1e-6);

  // From as far as a narrow lens allows, with the head turned away.
  navigator = navigator_about(kBall);
  navigator.set_field_of_view(1.0);
  navigator.zoom(-100.0, {640, 400}, std::nullopt);
  Camera away = navigator.camera();
  const double distance = glm::distance(away.eye, kUtm);
  away.target = 2.0 * away.eye - away.target;
  navigator.set_camera(away);
  navigator.set_field_of_view(45.0);
  EXPECT_LE(glm::distance(navigator.camera().eye, kUtm), distance * (1.0 + 1e-12));
}

TEST(Limits, OfAModelWhoseSpacingIsUnknownAreAShareOfItsSize) {
  Ball ball;
  ball.spacing = 0.0;
  EXPECT_NEAR(limits_for(extent_of(ball), {}, 1.6).least_height, 1e-4, 1e-12);
}

TEST(Limits, KeepPixelsLargerThanTheRoundingOfCoordinates) {
  Ball ball{kUtm, 100.0, 1e-9};
  const double height = limits_for(extent_of(ball), kUtm, 1.6).least_height;
  const double rounding = std::nextafter(kUtm.y, 1e300) - kUtm.y;
  EXPECT_GT(height / 1000.0, 5.0 * rounding);
  EXPECT_LT(height, 1e-4);
}

TEST(Limits, OfHostileBoundsAreFinite) {
  for (const double size : {0.0, 1e-320, 1e90, 1e120, 1e308, HUGE_VAL}) {
    PatchModel extent;
    extent.bounds = {glm::dvec3(-size), glm::dvec3(size)};
    extent.bounding_radius = size;
    Navigator navigator;
    navigator.set_model(extent, false);
    navigator.zoom(3.0, {10, 10}, std::nullopt);
    EXPECT_TRUE(is_usable(navigator.camera())) << size;
    navigator.fly({1, 1, -1}, 0.1, 1.0);
    navigator.frame_all();
    navigator.advance(0.1);
    EXPECT_TRUE(is_usable(navigator.camera())) << size;
  }
}

TEST(Projections, KeepThePlaneOfThePivot) {
  Navigator navigator = navigator_about(kBall);
  const glm::dvec2 cursor(700, 300);
  const glm::dvec3 pivot = *pick(kBall, navigator.camera(), cursor);
  navigator.zoom(3.0, cursor, pivot);
  const Camera perspective = navigator.camera();
  const double depth = depth_of(perspective, pivot);
  const auto check = [&](const Camera& camera) {
    for (const glm::dvec2 at : {cursor, glm::dvec2(10, 10), glm::dvec2(1200, 700)}) {
      const glm::dvec3 point = world_at(perspective, at, depth, kSize);
      EXPECT_LT(pixels_between(perspective, camera, point), kSamePixel);
    }
  };
  navigator.set_orthographic(true);
  EXPECT_TRUE(navigator.camera().is_orthographic());
  check(navigator.camera());
  navigator.set_orthographic(true);
  check(navigator.camera());
  navigator.set_orthographic(false);
  check(navigator.camera());
  EXPECT_LT(glm::distance(navigator.camera().eye, perspective.eye), 1e-7);
  for (const double degrees : {20.0, 90.0, 0.1, 45.0}) {
    navigator.set_field_of_view(degrees);
    EXPECT_NEAR(navigator.camera().vertical_fov_degrees, degrees, 1e-12);
    check(navigator.camera());
  }
  navigator.set_field_of_view(1e9);
  EXPECT_EQ(navigator.camera().vertical_fov_degrees, kMaxFieldOfView);
}

}  // namespace
}  // namespace relief
