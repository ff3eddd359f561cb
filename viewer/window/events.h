// What the user does to a window.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <variant>
#include <vector>

namespace relief {

enum class MouseButton : std::uint8_t { Left, Right, Middle };

/// Keys held down beside another or a button.
struct Modifiers {
  bool shift = false;
  bool control = false;
  bool alt = false;
};

/// Positions are in pixels of the image, from its upper left corner.
struct ButtonEvent {
  MouseButton button = MouseButton::Left;
  bool pressed = false;
  Modifiers modifiers;
  glm::dvec2 cursor{0.0};
  double seconds = 0.0;  ///< when, on the window's clock
};
struct MoveEvent {
  glm::dvec2 cursor{0.0};
};
struct WheelEvent {
  glm::dvec2 steps{0.0};  ///< fractional on touchpads; up and right are positive
  Modifiers modifiers;
  glm::dvec2 cursor{0.0};
};
struct KeyEvent {
  int key = 0;  ///< GLFW_KEY_...
  bool pressed = false;
  bool repeated = false;
  Modifiers modifiers;
};
/// A character that was typed, whatever keys that takes on the user's keyboard.
struct CharacterEvent {
  char32_t character = 0;
};
struct DropEvent {
  std::vector<std::filesystem::path> files;
};

using Event = std::variant<ButtonEvent, MoveEvent, WheelEvent, KeyEvent, CharacterEvent, DropEvent>;

}  // namespace relief
