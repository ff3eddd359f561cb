#include "viewer/choices/divider.h"

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

struct Reactor {
  double width;
  double reach;
  bool free;
  Divider& divider;

  [[nodiscard]] bool is_near(glm::dvec2 cursor) const {
    return free && std::abs(cursor.x - divider.share * width) <= reach;
  }

  bool operator()(const ButtonEvent& event) const {
    if (event.button != MouseButton::Left) return divider.is_held;
    if (!event.pressed) {
      const bool was_held = divider.is_held;
      divider.is_held = false;
      return was_held;
    }
    divider.is_held = is_near(event.cursor);
    divider.grip = event.cursor.x - divider.share * width;
    return divider.is_held;
  }

  bool operator()(const MoveEvent& event) const {
    divider.is_hovered = divider.is_held || is_near(event.cursor);
    if (!divider.is_held) return false;
    divider.share = std::clamp((event.cursor.x - divider.grip) / width, 0.0, 1.0);
    return true;
  }

  template <class Other>
  bool operator()(const Other& /*event*/) const {
    return false;
  }
};

}  // namespace

bool react_to(const Event& event, double width, double scale, bool free, Divider& divider) {
  return std::visit(Reactor{width, kGrabPixels * scale, free, divider}, event);
}

}  // namespace relief
