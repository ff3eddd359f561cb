// Pan and flight.
#include <gtest/gtest.h>

#include "ball.h"

namespace relief {
namespace {

TEST(Pan, KeepsThePointUnderTheCursor) {
  for (const bool orthographic : {false, true}) {
    Navigator navigator = navigator_about(kBall);
    navigator.set_orthographic(orthographic);
    const glm::dvec2 start(700, 300);
    const auto under = pick(kBall, navigator.camera(), start);
    ASSERT_TRUE(under);
    navigator.begin(DragKind::Pan, start, under);
    for (int i = 1; i < 200; ++i) {
      const glm::dvec2 cursor = start + glm::dvec2(-7.3 * i, 3.1 * i);
      navigator.drag(cursor);
      EXPECT_LT(glm::distance(*project(navigator.camera(), *under, kSize), cursor), kSamePixel);
    }
    navigator.end();
  }
}

TEST(Pan, OfTwoFingersIsThatOfADrag) {
  Navigator navigator = navigator_about(kBall);
  const glm::dvec2 cursor(700, 300);
  const auto under = pick(kBall, navigator.camera(), cursor);
  navigator.pan({12.5, -3.25}, cursor, under);
  const glm::dvec2 seen = *project(navigator.camera(), *under, kSize);
  EXPECT_LT(glm::distance(seen, cursor + glm::dvec2(12.5, -3.25)), kSamePixel);
}

TEST(Pan, OfTheBackgroundMovesWhatIsAsDeepAsThePivot) {
  Navigator navigator = navigator_about(kBall);
  const glm::dvec3 pivot = kUtm + glm::dvec3(20, -50, 30);
  navigator.set_pivot(pivot);
  const glm::dvec2 before = *project(navigator.camera(), pivot, kSize);
  navigator.pan({30, 40}, {3, 3}, std::nullopt);
  const glm::dvec2 after = *project(navigator.camera(), pivot, kSize);
  EXPECT_LT(glm::distance(after, before + glm::dvec2(30, 40)), kSamePixel);
}

TEST(Pan, OfTheBackgroundMovesWhatIsLookedAtIfThePivotIsBehind) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  navigator.set_pivot(first.eye + 50.0 * backward_of(first));
  navigator.pan({30, 40}, {3, 3}, std::nullopt);
  const glm::dvec2 after = *project(navigator.camera(), first.target, kSize);
  EXPECT_LT(glm::distance(after, 0.5 * kSize + glm::dvec2(30, 40)), kSamePixel);
}

TEST(Pan, EndsFarFromTheModel) {
  Navigator navigator = navigator_about(kBall);
  for (int i = 0; i < 1000; ++i) navigator.pan({500, 0}, {3, 3}, std::nullopt);
  const double distance = glm::distance(navigator.camera().eye, kUtm);
  EXPECT_GT(distance, 100.0 * kBall.radius);
  EXPECT_LT(distance, 125.0 * kBall.radius);
}

TEST(Fly, GoesWhereItIsToldAtASpeedThatFitsWhatIsAhead) {
  Navigator navigator = navigator_about(kBall);
  const Camera first = navigator.camera();
  const glm::dvec3 ahead = *pick(kBall, first, 0.5 * kSize);
  const double distance = glm::distance(ahead, first.eye);
  navigator.fly({1, 0, 0}, 0.1, 1.0, ahead);
  EXPECT_NEAR(glm::dot(navigator.camera().eye - first.eye, right_of(first)), 0.1 * distance, 1e-6);
  navigator.set_camera(first);
  navigator.fly({0, 1, 0}, 0.1, 2.0, ahead);
  EXPECT_NEAR((navigator.camera().eye - first.eye).z, 0.2 * distance, 1e-6) << "along the up axis";
  navigator.set_camera(first);
  navigator.fly({0, 0, -1}, 0.1, 1.0, ahead);
  EXPECT_GT(depth_of(navigator.camera(), ahead), distance);
}

TEST(Fly, DoesNotDependOnTheFrameRate) {
  Navigator once = navigator_about(kBall);
  Navigator often = navigator_about(kBall);
  const glm::dvec3 ahead = *pick(kBall, once.camera(), 0.5 * kSize);
  once.fly({0, 0, 1}, 0.5, 1.0, ahead);
  for (int i = 0; i < 50; ++i) often.fly({0, 0, 1}, 0.01, 1.0, ahead);
  EXPECT_LT(glm::distance(once.camera().eye, often.camera().eye), 1e-6);
}

TEST(Fly, NeverReachesWhatIsAhead) {
  Navigator navigator = navigator_about(kBall);
  for (int i = 0; i < 1000; ++i) {
    navigator.fly({0.02, 0.01, 1}, 0.1, 3.0, pick(kBall, navigator.camera(), 0.5 * kSize));
    ASSERT_GT(glm::distance(navigator.camera().eye, kUtm), kBall.radius);
  }
  EXPECT_LT(glm::distance(navigator.camera().eye, kUtm), kBall.radius + 1.0) << "but comes close";

  navigator = navigator_about(kBall);
  const glm::dvec3 ahead = *pick(kBall, navigator.camera(), 0.5 * kSize);
  for (int i = 0; i < 100; ++i) navigator.fly({0, 0, 1}, 0.1, 3.0, ahead);
  const double depth = depth_of(navigator.camera(), ahead);
  EXPECT_NEAR(image_height_at(navigator.camera(), depth), navigator.least_image_height(), 1e-7);
}

TEST(Fly, OverTheBackgroundIsNeverStuck) {
  Navigator navigator = navigator_about(kBall);
  navigator.set_pivot(navigator.camera().eye);
  const Camera first = navigator.camera();
  navigator.fly({0, 0, 1}, 1.0, 1.0);
  EXPECT_GT(glm::distance(navigator.camera().eye, first.eye), 0.01 * kBall.radius);
}

TEST(Fly, ForwardEnlargesAnOrthographicImage) {
  Navigator navigator = navigator_about(kBall);
  navigator.set_orthographic(true);
  const Camera first = navigator.camera();
  navigator.fly({0, 0, 1}, 0.1, 1.0);
  EXPECT_LT(navigator.camera().orthographic_height, first.orthographic_height);
  EXPECT_LT(glm::distance(navigator.camera().eye, first.eye), 1e-8);
}

}  // namespace
}  // namespace relief
