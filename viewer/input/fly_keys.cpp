#include "viewer/input/fly_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cstddef>

namespace relief {
namespace {

struct FlyKey {
  int key;  ///< GLFW_KEY_...
  glm::dvec3 along;
};

constexpr std::array<FlyKey, 6> kFlyKeys{{{GLFW_KEY_D, {1.0, 0.0, 0.0}},
                                          {GLFW_KEY_A, {-1.0, 0.0, 0.0}},
                                          {GLFW_KEY_E, {0.0, 1.0, 0.0}},
                                          {GLFW_KEY_Q, {0.0, -1.0, 0.0}},
                                          {GLFW_KEY_W, {0.0, 0.0, 1.0}},
                                          {GLFW_KEY_S, {0.0, 0.0, -1.0}}}};

}  // namespace

void FlyKeys::note(const Event& event, bool is_taken) {
  const auto* const key = std::get_if<KeyEvent>(&event);
  if (key == nullptr || key->repeated) return;
  is_fast_ = key->key == GLFW_KEY_LEFT_SHIFT || key->key == GLFW_KEY_RIGHT_SHIFT
                 ? key->pressed
                 : key->modifiers.shift;
  if (key->key == GLFW_KEY_LEFT_CONTROL || key->key == GLFW_KEY_RIGHT_CONTROL) {
    if (key->pressed) held_ = 0;
    return;
  }
  for (std::size_t k = 0; k < kFlyKeys.size(); ++k) {
    if (key->key != kFlyKeys[k].key) continue;
    if (!key->pressed)
      held_ &= ~(1U << k);
    else if (!is_taken && !key->modifiers.control)
      held_ |= 1U << k;
  }
}

glm::dvec3 FlyKeys::direction() const {
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < kFlyKeys.size(); ++k) {
    if ((held_ >> k & 1U) != 0) sum += kFlyKeys[k].along;
  }
  return sum;
}

}  // namespace relief
