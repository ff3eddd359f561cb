#include "viewer/choices/divider.h"

#include <gtest/gtest.h>

namespace relief {
namespace {

constexpr double kWidth = 1000.0;

bool press(Divider& divider, double x, double scale = 1.0, bool free = true) {
  return react_to(ButtonEvent{MouseButton::Left, true, {}, {x, 300.0}, 0.0}, kWidth, scale, free,
                  divider);
}
bool release(Divider& divider, double x) {
  return react_to(ButtonEvent{MouseButton::Left, false, {}, {x, 300.0}, 0.0}, kWidth, 1.0, true,
                  divider);
}
bool move(Divider& divider, double x, bool free = true) {
  return react_to(MoveEvent{{x, 310.0}}, kWidth, 1.0, free, divider);
}

TEST(Divider, IsGrabbedWithinSixPixelsAndNoFarther) {
  Divider divider;
  EXPECT_FALSE(press(divider, 493.0));
  EXPECT_FALSE(press(divider, 507.0));
  EXPECT_TRUE(press(divider, 494.0));
  EXPECT_TRUE(release(divider, 494.0));
  EXPECT_TRUE(press(divider, 506.0));
}

TEST(Divider, IsGrabbedFromAfarWherePixelsAreDense) {
  Divider divider;
  EXPECT_TRUE(press(divider, 512.0, 2.0));
  Divider other;
  EXPECT_FALSE(press(other, 513.0, 2.0));
}

TEST(Divider, FollowsTheCursorWithoutAJump) {
  Divider divider;
  press(divider, 505.0);
  EXPECT_TRUE(move(divider, 505.0));
  EXPECT_DOUBLE_EQ(divider.share, 0.5);
  EXPECT_TRUE(move(divider, 705.0));
  EXPECT_DOUBLE_EQ(divider.share, 0.7);
  EXPECT_TRUE(release(divider, 705.0));
  EXPECT_FALSE(move(divider, 100.0));
  EXPECT_DOUBLE_EQ(divider.share, 0.7);
}

TEST(Divider, StaysInThePictureAndCanBeFetchedFromItsRim) {
  Divider divider;
  press(divider, 500.0);
  move(divider, 5000.0);
  EXPECT_EQ(divider.share, 1.0);
  release(divider, 5000.0);
  EXPECT_TRUE(press(divider, 996.0));
  move(divider, -300.0);
  EXPECT_EQ(divider.share, 0.0);
}

TEST(Divider, LeavesToOthersWhatIsTheirs) {
  Divider divider;
  EXPECT_FALSE(press(divider, 500.0, 1.0, false));  // over a panel
  EXPECT_FALSE(move(divider, 500.0, false));        // while the camera is dragged across it
  EXPECT_FALSE(divider.is_hovered);
  EXPECT_FALSE(release(divider, 500.0));  // of a button that began elsewhere
  EXPECT_FALSE(react_to(ButtonEvent{MouseButton::Right, true, {}, {500.0, 0.0}, 0.0}, kWidth, 1.0,
                        true, divider));
  EXPECT_FALSE(react_to(WheelEvent{{0.0, 1.0}, {}, {500.0, 0.0}}, kWidth, 1.0, true, divider));
}

TEST(Divider, TakesAllButtonsWhileItIsHeld) {
  Divider divider;
  press(divider, 500.0);
  EXPECT_TRUE(react_to(ButtonEvent{MouseButton::Right, true, {}, {500.0, 0.0}, 0.0}, kWidth, 1.0,
                       true, divider));
}

TEST(Divider, LightsUpUnderTheCursor) {
  Divider divider;
  EXPECT_FALSE(move(divider, 502.0));  // others may see the cursor move
  EXPECT_TRUE(divider.is_hovered);
  move(divider, 530.0);
  EXPECT_FALSE(divider.is_hovered);
}

}  // namespace
}  // namespace relief
