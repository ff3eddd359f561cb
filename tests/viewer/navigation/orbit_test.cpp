// Orbit, look and roll.
#include <gtest/gtest.h>

#include <array>
#include <glm/trigonometric.hpp>
#include <vector>

#include "ball.h"
#include "common/scene/scene.h"

namespace relief {
namespace {

const Ball kOriginBall;

/// Cursors of a drag with small and large steps, far out of the image and back.
std::vector<glm::dvec2> path_from(glm::dvec2 start) {
  std::vector<glm::dvec2> path;
  for (int i = 1; i <= 200; ++i)
    path.push_back(start + glm::dvec2(9.0 * i, 700.0 * std::sin(0.05 * i)));
  path.push_back(start);
  return path;
}

/// Cameras that are not level, or look along the up axis.
std::vector<Camera> odd_cameras(glm::dvec3 centre) {
  return {{centre + glm::dvec3(0, 0, 400), centre, {0, 1, 0}},       // straight down
          {centre + glm::dvec3(0, 0, 400), centre, {0, 0, 1}},       // with no usable up direction
          {centre + glm::dvec3(0, 0, -400), centre, {1, 0, 0}},      // straight up
          {centre + glm::dvec3(1e-9, 0, 400), centre, {0, 1, 0}},    // almost straight down
          {centre + glm::dvec3(300, -200, 50), centre, {0, 0, -1}},  // upside down
          {centre + glm::dvec3(300, -200, 50), centre, {0.8, 1, 0.2}},  // rolled
          {centre + glm::dvec3(300, 0, 0), centre, {0, 1, 0}},          // rolled by 90 degrees
          {centre + glm::dvec3(0, -400, 0), centre + glm::dvec3(80, 0, 9), {0, 0, 1}, 20.0, 300.0}};
}

TEST(Orbit, KeepsThePointUnderTheCursorAtItsPixel) {
  for (const Ball& ball : {kOriginBall, kBall}) {
    for (const bool orthographic : {false, true}) {
      for (const OrbitStyle style : {OrbitStyle::Turntable, OrbitStyle::Trackball}) {
        Navigator navigator = navigator_about(ball);
        navigator.set_orthographic(orthographic);
        navigator.set_orbit_style(style);
        const glm::dvec2 cursor(800, 300);
        const Camera first = navigator.camera();
        const auto under = pick(ball, first, cursor);
        ASSERT_TRUE(under);
        navigator.begin(DragKind::Orbit, cursor, under);
        for (const glm::dvec2 to : path_from(cursor)) {
          navigator.drag(to);
          ASSERT_LT(pixels_between(first, navigator.camera(), *under), kSamePixel);
        }
        EXPECT_LT(shift_between(first, navigator.camera(), ball), kSamePixel) << "cursor came back";
        EXPECT_LT(glm::distance(navigator.pivot(), *under), 1e-8);
      }
    }
  }
}

TEST(Orbit, TurnsTheBackgroundAboutThePivotAndWithoutOneInTheImageAboutTheCentre) {
  Navigator navigator = navigator_about(kBall);
  const glm::dvec3 pivot = kUtm + glm::dvec3(40, -10, 20);
  navigator.set_pivot(pivot);
  const Camera first = navigator.camera();
  navigator.begin(DragKind::Orbit, {2, 2}, std::nullopt);
  navigator.drag({300, 100});
  EXPECT_LT(pixels_between(first, navigator.camera(), pivot), kSamePixel);
  EXPECT_GT(shift_between(first, navigator.camera(), kBall), 50.0);
  navigator.end();

  navigator.set_pivot(navigator.camera().eye + glm::dvec3(0, 0, 500));
  const Camera second = navigator.camera();
  navigator.begin(DragKind::Orbit, {2, 2}, std::nullopt);
  navigator.drag({300, 100});
  EXPECT_LT(pixels_between(second, navigator.camera(), kUtm), kSamePixel);
}

TEST(Orbit, TurnsTheModelWithTheCursor) {
  for (const OrbitStyle style : {OrbitStyle::Turntable, OrbitStyle::Trackball}) {
    Navigator navigator = navigator_about(kOriginBall);
    navigator.set_orbit_style(style);
    const Camera first = navigator.camera();
    const glm::dvec3 front = *pick(kOriginBall, first, 0.5 * kSize);
    navigator.begin(DragKind::Orbit, {2, 2}, std::nullopt);
    navigator.drag({30, 22});
    const glm::dvec2 shift =
        *project(navigator.camera(), front, kSize) - *project(first, front, kSize);
    EXPECT_GT(shift.x, 5.0);
    EXPECT_GT(shift.y, 5.0);
  }
}

TEST(Orbit, OfATurntableStaysLevelAndStopsBeforeThePoles) {
  Navigator navigator = navigator_about(kOriginBall);
  for (const double side : {1.0, -1.0}) {
    navigator.begin(DragKind::Orbit, {640, 400}, std::nullopt);
    glm::dvec3 right = right_of(navigator.camera());
    for (int i = 0; i < 1000; ++i) {
      navigator.drag({640.0 + 0.2 * i, 400.0 + 5.0 * side * i});
      EXPECT_NEAR(right_of(navigator.camera()).z, 0.0, 1e-9);
      EXPECT_GT(up_of(navigator.camera()).z, 0.0);
      EXPECT_GT(glm::dot(right, right_of(navigator.camera())), 0.99) << "flipped";
      right = right_of(navigator.camera());
    }
    const double elevation = glm::degrees(std::asin(backward_of(navigator.camera()).z));
    EXPECT_NEAR(elevation, 89.9 * side, 1e-6);
    navigator.end();
  }
}

TEST(Orbit, NeverJumpsFromAnyCamera) {
  // A step of 1.4 pixels is 0.3 degrees of an orbit and, 205 pixels from the image's middle, 0.4 of
  // a roll: 6 pixels at the model's rim, 600 from the middle or as near to the eye as the pivot.
  constexpr double kMostPixels = 8.0;
  const glm::dvec2 start(780, 250);
  for (const Ball& ball : {kOriginBall, kBall}) {
    for (const Camera& camera : odd_cameras(ball.centre)) {
      for (const DragKind kind :
           {DragKind::Orbit, DragKind::Look, DragKind::Pan, DragKind::Zoom, DragKind::Roll}) {
        Navigator navigator = navigator_about(ball);
        navigator.set_camera(camera);
        navigator.begin(kind, start, pick(ball, camera, start));
        navigator.drag(start);
        EXPECT_EQ(navigator.camera().eye, camera.eye);
        Camera last = camera;
        for (const glm::dvec2 shift :
             {glm::dvec2(0.001, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1),
              glm::dvec2(-1, 0), glm::dvec2(-1, -1), glm::dvec2(0, 0.001)}) {
          navigator.drag(start + shift);
          EXPECT_LT(shift_between(last, navigator.camera(), ball), kMostPixels);
          last = navigator.camera();
        }
        EXPECT_LT(shift_between(camera, last, ball), 0.01) << "the cursor came back";
      }
    }
  }
}

TEST(Orbit, OfACameraThatIsNotLevelKeepsTheTiltOfItsHorizon) {
  for (const Camera& camera : odd_cameras({})) {
    Navigator navigator = navigator_about(kOriginBall);
    navigator.set_camera(camera);
    const double tilt = right_of(camera).z;
    navigator.begin(DragKind::Orbit, {600, 350}, std::nullopt);
    for (const glm::dvec2 to : path_from({600, 350})) {
      navigator.drag(to);
      EXPECT_NEAR(right_of(navigator.camera()).z, tilt, 1e-9);
    }
  }
}

TEST(Orbit, FromStraightAboveTurnsInThePlaneAndTiltsUpright) {
  Navigator navigator = navigator_about(kOriginBall);
  navigator.look_from(*find_named(kViews, "top"));
  navigator.advance(1.0);
  navigator.begin(DragKind::Orbit, {600, 350}, std::nullopt);
  navigator.drag({800, 350});
  EXPECT_NEAR(backward_of(navigator.camera()).z, 1.0, 1e-12);
  navigator.drag({800, 150});  // the model's far side comes up: one looks from the front
  EXPECT_LT(backward_of(navigator.camera()).z, 0.9);
  EXPECT_NEAR(right_of(navigator.camera()).z, 0.0, 1e-12);
  EXPECT_GT(up_of(navigator.camera()).z, 0.1);
}

TEST(Orbit, OfATrackballGoesOverThePoles) {
  Navigator navigator = navigator_about(kOriginBall);
  navigator.set_orbit_style(OrbitStyle::Trackball);
  navigator.begin(DragKind::Orbit, {640, 400}, std::nullopt);
  navigator.drag({640, 1200});  // half a turn
  EXPECT_LT(up_of(navigator.camera()).z, -0.9);
}

TEST(Orbit, OfACameraThatIsUpsideDownTurnsTheModelWithTheCursor) {
  Navigator navigator = navigator_about(kOriginBall);
  navigator.set_camera(rolled(navigator.camera(), 180.0));
  const Camera first = navigator.camera();
  const glm::dvec3 front = *pick(kOriginBall, first, 0.5 * kSize);
  navigator.begin(DragKind::Orbit, {2, 2}, std::nullopt);
  navigator.drag({30, 2});
  EXPECT_GT(project(navigator.camera(), front, kSize)->x, 0.5 * kSize.x + 5.0);
}

TEST(Orbit, OfAnOrthographicCameraNeverCutsTheModel) {
  Navigator navigator = navigator_about(kOriginBall);
  const glm::dvec2 cursor(660, 420);
  for (int i = 0; i < 20; ++i)
    navigator.zoom(1.0, cursor, pick(kOriginBall, navigator.camera(), cursor));
  navigator.set_orthographic(true);
  navigator.begin(DragKind::Orbit, cursor, pick(kOriginBall, navigator.camera(), cursor));
  for (const glm::dvec2 to : path_from(cursor)) {
    navigator.drag(to);
    EXPECT_GT(depth_of(navigator.camera(), kOriginBall.centre), kOriginBall.radius);
  }
}

TEST(Orbit, OfAnOrthographicCameraThatCutsTheModelGoesOnCutting) {
  Navigator navigator = navigator_about(kOriginBall);
  navigator.set_camera({{0, -10, 0}, {0, 0, 0}, {0, 0, 1}, 45.0, 300.0});
  navigator.begin(DragKind::Orbit, {640, 400}, glm::dvec3(0));
  navigator.drag({650, 400});
  EXPECT_NEAR(depth_of(navigator.camera(), kOriginBall.centre), 10.0, 1e-9);
}

TEST(Drag, GoesOnWithoutAJumpAfterTheWheelAndANewSize) {
  for (const DragKind kind :
       {DragKind::Orbit, DragKind::Look, DragKind::Pan, DragKind::Zoom, DragKind::Roll}) {
    Navigator navigator = navigator_about(kBall);
    const glm::dvec2 cursor(780, 250);
    navigator.begin(kind, cursor, pick(kBall, navigator.camera(), cursor));
    navigator.drag(cursor + glm::dvec2(80, -60));
    navigator.zoom(2.0, cursor, pick(kBall, navigator.camera(), cursor));
    Camera before = navigator.camera();
    navigator.drag(cursor + glm::dvec2(80.001, -60));
    EXPECT_LT(shift_between(before, navigator.camera(), kBall), 0.02);
    before = navigator.camera();
    navigator.set_image({640, 300});
    navigator.drag(cursor + glm::dvec2(80, -60));
    EXPECT_LT(shift_between(before, navigator.camera(), kBall), 0.05);
    EXPECT_TRUE(navigator.is_dragging());
  }
}

TEST(Look, TurnsAboutTheEyeAndTheSceneFollowsTheCursor) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  const glm::dvec3 middle = *pick(kBall, first, 0.5 * kSize);
  navigator.begin(DragKind::Look, 0.5 * kSize, middle);
  navigator.drag(0.5 * kSize + glm::dvec2(8, 5));
  EXPECT_LT(glm::distance(navigator.camera().eye, first.eye), 1e-9);
  const glm::dvec2 shift = *project(navigator.camera(), middle, kSize) - 0.5 * kSize;
  EXPECT_NEAR(shift.x, 8.0, 0.5);  // a turntable's circles narrow with elevation, here 15 degrees
  EXPECT_NEAR(shift.y, 5.0, 0.5);
}

TEST(Roll, TurnsTheImageWithTheCursorAndNotNearItsMiddle) {
  Navigator navigator = navigator_about(kOriginBall);
  const Camera first = navigator.camera();
  navigator.begin(DragKind::Roll, {940, 400}, std::nullopt);
  navigator.drag({640, 400});  // the middle: no angle
  navigator.drag({641, 402});
  EXPECT_LT(shift_between(first, navigator.camera(), kOriginBall), 1e-9);
  navigator.drag({940, 400});
  navigator.drag({852, 612});
  navigator.drag({640, 700});  // a quarter clockwise
  EXPECT_NEAR(glm::dot(right_of(navigator.camera()), up_of(first)), 1.0, 1e-9);
  EXPECT_LT(glm::distance(navigator.camera().eye, first.eye), 1e-9);
}

}  // namespace
}  // namespace relief
