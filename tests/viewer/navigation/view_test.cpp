// Views and transitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>

#include "ball.h"
#include "common/scene/scene.h"
#include "common/scene/views/framing.h"
#include "common/scene/views/view_camera.h"
#include "viewer/navigation/transition.h"

namespace relief {
namespace {

SceneSettings settings_of_image() {
  SceneSettings settings;
  settings.size = kImage;
  return settings;
}

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.vertical_fov_degrees, b.vertical_fov_degrees);
  EXPECT_EQ(a.orthographic_height, b.orthographic_height);
}

/// Goes on until the transition is over, with a check of each frame.
template <class Check>
void finish(Navigator& navigator, const Check& check) {
  int frames = 0;
  while (navigator.advance(0.01)) {
    ASSERT_TRUE(navigator.moving());
    ASSERT_LT(++frames, 40);
    check(navigator.camera());
  }
  EXPECT_FALSE(navigator.moving());
}
void finish(Navigator& navigator) {
  finish(navigator, [](const Camera& camera) { EXPECT_TRUE(is_usable(camera)); });
}

TEST(Views, BeginWithTheCameraOfRender) {
  Navigator navigator = navigator_about(kBall);
  const Camera expected = *camera_for(settings_of_image(), extent_of(kBall));
  expect_same(navigator.camera(), expected);
  EXPECT_FALSE(navigator.moving());
  navigator.zoom(5.0, {3, 3}, std::nullopt);
  navigator.home();
  finish(navigator);
  expect_same(navigator.camera(), expected);
}

TEST(Views, AreThoseOfRender) {
  Navigator navigator = navigator_about(kBall);
  for (const bool orthographic : {false, true}) {
    navigator.set_orthographic(orthographic);
    for (const auto& view : kViews) {
      navigator.look_from(view.value);
      finish(navigator);
      SceneSettings settings = settings_of_image();
      settings.orbit = view.value;
      if (orthographic) settings.orthographic = OrthographicSize{};
      expect_same(navigator.camera(), *camera_for(settings, extent_of(kBall)));
      navigator.frame_all();
      finish(navigator);
      EXPECT_LT(shift_between(navigator.camera(), *camera_for(settings, extent_of(kBall)), kBall),
                kSamePixel);
    }
  }
}

TEST(Views, FollowTheSizeOfAWindowThatNobodyHasTouched) {
  Navigator navigator = navigator_about(kBall);
  SceneSettings settings = settings_of_image();
  settings.size = ImageSize{300, 900};
  navigator.set_image(*settings.size);
  expect_same(navigator.camera(), *camera_for(settings, extent_of(kBall)));
  navigator.zoom(1.0, {3, 3}, std::nullopt);
  const Camera touched = navigator.camera();
  navigator.set_image(kImage);
  expect_same(navigator.camera(), touched);
}

TEST(Views, AreLeftWhereSomeoneHasStoppedThem) {
  Navigator navigator = navigator_about(kBall);
  navigator.zoom(5.0, {600, 300}, std::nullopt);
  navigator.home();
  navigator.advance(0.1);
  navigator.begin(DragKind::Pan, {600, 300}, std::nullopt);
  navigator.end();
  const Camera stopped = navigator.camera();
  navigator.set_image({300, 900});
  expect_same(navigator.camera(), stopped);
}

TEST(Views, StandTheModelOnTheAxisThatIsAskedFor) {
  Navigator navigator = navigator_about(kBall);
  navigator.set_up_axis(glm::dvec3(0, 3, 0));
  finish(navigator);
  SceneSettings settings = settings_of_image();
  settings.up = glm::dvec3(0, 3, 0);
  expect_same(navigator.camera(), *camera_for(settings, extent_of(kBall)));
  EXPECT_EQ(navigator.stance().up, glm::dvec3(0, 1, 0));
  navigator.set_up_axis(std::nullopt);
  EXPECT_EQ(navigator.stance(), kZUp);
}

TEST(Views, OfAnotherModelKeepTheCameraIfAskedTo) {
  Navigator navigator = navigator_about(kBall);
  navigator.zoom(2.0, {600, 300}, std::nullopt);
  const Camera before = navigator.camera();
  navigator.set_model(extent_of({kUtm + 50.0, 300.0, 0.2}), true);
  expect_same(navigator.camera(), before);
  navigator.set_model(extent_of({kUtm + 50.0, 300.0, 0.2}), false);
  expect_same(navigator.camera(),
              *camera_for(settings_of_image(), extent_of({kUtm + 50.0, 300.0, 0.2})));
}

TEST(Views, FrameASelection) {
  Navigator navigator = navigator_about(kBall);
  const glm::dvec3 direction = backward_of(navigator.camera());
  const std::array<glm::dvec3, 2> points{kUtm + glm::dvec3(10, 0, 0), kUtm + glm::dvec3(10, 9, 7)};
  navigator.frame(points);
  finish(navigator);
  EXPECT_LT(glm::distance(backward_of(navigator.camera()), direction), 1e-9);
  double tallest = 0.0;
  for (const glm::dvec3& p : points) {
    const glm::dvec2 seen = *project(navigator.camera(), p, kSize) / kSize - 0.5;
    tallest = std::max({tallest, std::abs(seen.x), std::abs(seen.y)});
  }
  EXPECT_LE(tallest, 0.5 * kFramedShare + 1e-6);
  EXPECT_GT(tallest, 0.8 * 0.5 * kFramedShare) << "not more around it";

  navigator.frame(std::array{kUtm});
  finish(navigator);
  EXPECT_LT(glm::distance(*project(navigator.camera(), kUtm, kSize), 0.5 * kSize), kSamePixel);
  EXPECT_GT(glm::distance(navigator.camera().eye, kUtm), 10.0 * kBall.spacing);
}

TEST(Views, RollAndLevel) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  navigator.roll(15.0);
  navigator.roll(15.0);  // while the first one is under way
  finish(navigator);
  EXPECT_LT(shift_between(navigator.camera(), rolled(first, 30.0), kBall), kSamePixel);
  navigator.level();
  finish(navigator);
  EXPECT_LT(shift_between(navigator.camera(), first, kBall), kSamePixel);
}

TEST(Transition, IsSmoothAndStartsWhereTheCameraIs) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  navigator.look_from(*find_named(kViews, "top"));
  navigator.advance(1e-9);
  EXPECT_LT(shift_between(first, navigator.camera(), kBall), kSamePixel);
  Camera last = first;
  // 90 degrees in 30 frames, 1.5 times as fast in the middle: 4.5 degrees, 8 % of the image's
  // height.
  finish(navigator, [&](const Camera& camera) {
    EXPECT_LT(shift_between(last, camera, kBall), 0.08 * kSize.y);
    last = camera;
  });
  EXPECT_LT(shift_between(last, navigator.camera(), kBall), 0.02 * kSize.y);
}

TEST(Transition, BetweenAllViewsStaysOutsideTheModel) {
  Navigator navigator = navigator_about(kBall);
  for (const auto& from : kViews) {
    for (const auto& to : kViews) {
      navigator.look_from(from.value);
      finish(navigator);
      const double start = glm::distance(navigator.camera().eye, kUtm);
      navigator.look_from(to.value);
      finish(navigator, [&](const Camera& camera) {
        EXPECT_TRUE(is_usable(camera));
        EXPECT_GT(glm::distance(camera.eye, kUtm), 0.7 * start);
      });
    }
  }
}

TEST(Transition, BetweenOrthographicCamerasNeverCutsTheModel) {
  Navigator navigator = navigator_about(kBall);
  const auto camera_at = [](double y) {
    return Camera{
        kUtm + glm::dvec3(0, 1.06 * y, 0), kUtm + glm::dvec3(0, y, 0), {0, 0, 1}, 45.0, 9.0};
  };
  navigator.set_camera(camera_at(-100));
  navigator.go_to(camera_at(100));
  finish(navigator, [](const Camera& camera) { EXPECT_GT(depth_of(camera, kUtm), 100.0); });
}

TEST(Transition, BetweenDistantCloseUpsGoesBackAndAcross) {
  Navigator navigator = navigator_about(kBall);
  const Camera left{kUtm + glm::dvec3(-60, -100, 0), kUtm + glm::dvec3(-60, -90, 0), {0, 0, 1}};
  const Camera right{kUtm + glm::dvec3(60, -100, 0), kUtm + glm::dvec3(60, -90, 0), {0, 0, 1}};
  navigator.set_camera(left);
  navigator.go_to(right);
  double farthest = 0.0;
  finish(navigator,
         [&](const Camera& camera) { farthest = std::max(farthest, kUtm.y - camera.eye.y); });
  EXPECT_GT(farthest, 130.0) << "a straight line would stay at 100, in the ball";
  expect_same(navigator.camera(), right);
  EXPECT_EQ(navigator.pivot(), right.target);
}

TEST(Transition, GoesStraightWhereOnlyTheDistanceChanges) {
  Pose from;
  from.eye = {0, 0, 100};
  from.focus = 100;
  Pose to = from;
  to.eye = {0, 0, 1};
  to.focus = 1;
  const Pose middle = pose_between(from, to, 0.5, 1e4);
  EXPECT_NEAR(middle.focus, 10.0, 1e-9) << "log-distance";
  EXPECT_LT(glm::distance(middle.eye, {0, 0, 10}), 1e-9);
}

TEST(Transition, FollowsThePathOfVanWijk) {
  // The example of interpolateZoom in the documentation of D3: (30, 30), 40 wide, to (135, 85), 60.
  const auto pose = [](double x, double y, double height) {
    Pose result;
    result.eye = {x, y, 1.0};
    result.orthographic_height = height;
    return result;
  };
  const Pose middle = pose_between(pose(30, 30, 40), pose(135, 85, 60), 0.5, 1e4);
  EXPECT_NEAR(middle.eye.x, 72.0, 1e-9);
  EXPECT_NEAR(middle.eye.y, 52.0, 1e-9);
  EXPECT_NEAR(middle.orthographic_height, 126.04761005270991, 1e-9);
}

TEST(Transition, BetweenProjectionsKeepsTheSizeOfWhatIsSeen) {
  Navigator navigator = navigator_about(kBall);
  const Camera perspective = navigator.camera();
  Camera orthographic = perspective;
  orthographic.orthographic_height =
      image_height_at(perspective, glm::distance(perspective.eye, perspective.target));
  for (const Camera& to : {orthographic, perspective}) {
    navigator.go_to(to);
    finish(navigator, [&](const Camera& camera) {
      EXPECT_FALSE(camera.is_orthographic());
      EXPECT_LT(pixels_between(camera, to, perspective.target + 50.0 * up_of(perspective)), 1e-4);
    });
    expect_same(navigator.camera(), to);
  }
}

TEST(Transition, EndsWhereItIsAtTheFirstInput) {
  Navigator navigator = navigator_about(kBall);
  navigator.look_from(*find_named(kViews, "back"));
  navigator.advance(0.1);
  const Camera now = navigator.camera();
  navigator.begin(DragKind::Orbit, {600, 300}, std::nullopt);
  EXPECT_FALSE(navigator.moving());
  navigator.drag({600, 300});
  expect_same(navigator.camera(), now);
}

TEST(Transition, ToTheSameOrTheOppositeCameraIsFinite) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  const glm::dvec3 behind = 2.0 * first.target - first.eye;
  for (const Camera& to : {first, Camera{behind, first.target, first.up},
                           Camera{first.eye, behind, -first.up}, rolled(first, 180.0)}) {
    navigator.set_camera(first);
    navigator.go_to(to);
    finish(navigator);
    expect_same(navigator.camera(), to);
  }
}

TEST(Transition, ToAnUnusableCameraIsNone) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  navigator.go_to({kUtm, kUtm});
  navigator.go_to({glm::dvec3(NAN), kUtm});
  EXPECT_FALSE(navigator.moving());
  expect_same(navigator.camera(), first);
}

}  // namespace
}  // namespace relief
