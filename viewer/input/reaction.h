// From what the user does to what the window shows.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "viewer/session.h"
#include "viewer/window/events.h"

namespace relief {

/// What the mouse is doing.
struct Pointer {
  std::optional<MouseButton> held;
  DragKind kind = DragKind::Orbit;  ///< what a drag does
  glm::dvec2 pressed_at{0.0};
  std::optional<glm::dvec3> under;  ///< the surface there
  bool has_moved = false;           ///< since it was pressed, by more than a trembling hand
  double last_click = -1.0;         ///< seconds
  glm::dvec2 last_click_at{0.0};
  glm::dvec2 cursor{0.0};
};

/// Finds the surface below a cursor; none over the background.
using SurfaceFinder = std::function<std::optional<glm::dvec3>(glm::dvec2 cursor)>;

/// What an event was, beside what it changed in the session.
struct Reaction {
  bool changes = false;             ///< the camera or what is shown
  std::optional<glm::dvec2> click;  ///< pressed and released at one place, left button
  bool is_double = false;           ///< the click is the second of two
  std::vector<std::filesystem::path> dropped;
  bool adds_dropped = false;  ///< to the open files
};

/// Applies an event to the camera. What a panel takes must not come here, but for releases.
Reaction react_to(const Event& event, const SurfaceFinder& surface, Pointer& pointer,
                  Session& session);

}  // namespace relief
