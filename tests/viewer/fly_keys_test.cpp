#include "viewer/input/fly_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace relief {
namespace {

constexpr Modifiers kControl{.control = true};

KeyEvent press(int key, Modifiers modifiers = {}) {
  return {.key = key, .pressed = true, .modifiers = modifiers};
}
KeyEvent release(int key, Modifiers modifiers = {}) {
  return {.key = key, .modifiers = modifiers};
}

TEST(FlyKeys, FlyWhileTheyAreHeld) {
  FlyKeys keys;
  keys.note(press(GLFW_KEY_W), false);
  keys.note(press(GLFW_KEY_D), false);
  EXPECT_EQ(keys.direction(), glm::dvec3(1, 0, 1));
  keys.note(release(GLFW_KEY_W), false);
  EXPECT_EQ(keys.direction(), glm::dvec3(1, 0, 0));
  keys.note(release(GLFW_KEY_D), false);
  EXPECT_FALSE(keys.is_flying());
}

// Ctrl+S writes a picture; the camera moved where Control was let go before S, and the picture was
// of another view than the one that was seen.
TEST(FlyKeys, LeaveShortcutsAlone) {
  FlyKeys keys;
  keys.note(press(GLFW_KEY_LEFT_CONTROL), false);
  keys.note(press(GLFW_KEY_S, kControl), false);
  keys.note(release(GLFW_KEY_LEFT_CONTROL, kControl), false);
  EXPECT_FALSE(keys.is_flying());
  KeyEvent repeat = press(GLFW_KEY_S);
  repeat.repeated = true;
  keys.note(repeat, false);
  EXPECT_FALSE(keys.is_flying());
  keys.note(release(GLFW_KEY_S), false);
  keys.note(press(GLFW_KEY_S), false);
  EXPECT_TRUE(keys.is_flying());
}

TEST(FlyKeys, EndTheirFlightWithControl) {
  FlyKeys keys;
  keys.note(press(GLFW_KEY_W), false);
  keys.note(press(GLFW_KEY_RIGHT_CONTROL), false);
  EXPECT_FALSE(keys.is_flying());
}

TEST(FlyKeys, AreNoKeysThatAPanelTakes) {
  FlyKeys keys;
  keys.note(press(GLFW_KEY_A), true);
  EXPECT_FALSE(keys.is_flying());
  keys.note(press(GLFW_KEY_E), false);
  keys.note(release(GLFW_KEY_E), true);
  EXPECT_FALSE(keys.is_flying());
}

TEST(FlyKeys, AreFasterWithShift) {
  FlyKeys keys;
  keys.note(press(GLFW_KEY_W), false);
  EXPECT_EQ(keys.speed_factor(), 1.0);
  keys.note(press(GLFW_KEY_LEFT_SHIFT), false);
  EXPECT_EQ(keys.speed_factor(), 3.0);
  keys.note(release(GLFW_KEY_LEFT_SHIFT, {.shift = true}), false);
  EXPECT_EQ(keys.speed_factor(), 1.0);
}

}  // namespace
}  // namespace relief
