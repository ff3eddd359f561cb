#include "viewer/input/reaction.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "viewer/input/shortcuts.h"

namespace relief {
namespace {

/// A hand trembles by this, in pixels.
constexpr double kTremble = 4.0;
constexpr double kDoubleClickSeconds = 0.35;

/// Keys that look from a side, as number keys in other programs: 1 to 7 in the order of kViews.
constexpr int kFirstViewKey = GLFW_KEY_1;

DragKind drag_of(MouseButton button, const Modifiers& modifiers) {
  if (button == MouseButton::Middle || button == MouseButton::Right || modifiers.shift)
    return DragKind::Pan;
  if (modifiers.control) return DragKind::Look;
  return modifiers.alt ? DragKind::Roll : DragKind::Orbit;
}

struct Reactor {
  const SurfaceFinder& surface;
  Pointer& pointer;
  Session& session;
  Reaction reaction = {};

  void operator()(const ButtonEvent& event) {
    pointer.cursor = event.cursor;
    if (event.pressed && !pointer.held) {
      pointer.held = event.button;
      pointer.pressed_at = event.cursor;
      pointer.has_moved = false;
      pointer.kind = drag_of(event.button, event.modifiers);
      pointer.under = surface(event.cursor);
    } else if (!event.pressed && pointer.held == event.button) {
      pointer.held.reset();
      session.navigator.end();
      if (pointer.has_moved || event.button != MouseButton::Left) return;
      reaction.click = event.cursor;
      reaction.is_double = event.seconds - pointer.last_click < kDoubleClickSeconds &&
                           glm::distance(event.cursor, pointer.last_click_at) <= kTremble;
      pointer.last_click = event.seconds;
      pointer.last_click_at = event.cursor;
    }
  }

  void operator()(const MoveEvent& event) {
    pointer.cursor = event.cursor;
    if (!pointer.held) return;
    if (!pointer.has_moved) {
      if (glm::distance(event.cursor, pointer.pressed_at) <= kTremble) return;
      pointer.has_moved = true;
      // From here: from where it was pressed the picture would jump.
      session.navigator.begin(pointer.kind, event.cursor, pointer.under);
    }
    session.navigator.drag(event.cursor);
    reaction.changes = true;
  }

  void operator()(const WheelEvent& event) {
    pointer.cursor = event.cursor;
    session.navigator.zoom(event.steps.y, event.cursor, surface(event.cursor));
    reaction.changes = true;
  }

  void operator()(const KeyEvent& event) {
    if (!event.pressed) return;
    if (react_to_shortcut(event.key, event.modifiers, session)) {
      reaction.changes = true;
      return;
    }
    if (event.modifiers.control) return;
    Navigator& navigator = session.navigator;
    const int view = event.key - kFirstViewKey;
    if (view >= 0 && view < static_cast<int>(kViews.size())) {
      navigator.look_from(kViews[static_cast<std::size_t>(view)].value);
    } else if (event.key == GLFW_KEY_HOME) {
      navigator.home();
    } else if (event.key == GLFW_KEY_F) {
      navigator.frame_all();
    } else if (event.key == GLFW_KEY_L) {
      navigator.level();
    } else if (event.key == GLFW_KEY_O) {
      // What is in the middle keeps its size.
      if (const auto middle = surface(0.5 * glm::dvec2(session.window)))
        navigator.set_pivot(*middle);
      navigator.set_orthographic(!navigator.camera().is_orthographic());
    } else if (event.key == GLFW_KEY_TAB) {
      session.shows_panels = !session.shows_panels;
    } else if (event.key == GLFW_KEY_ESCAPE) {
      session.shows_help = false;
    }
    reaction.changes = true;
  }

  void operator()(const CharacterEvent& event) {
    if (event.character == U'?') session.shows_help = !session.shows_help;
  }

  void operator()(const DropEvent& event) { reaction.dropped = event.files; }
};

}  // namespace

Reaction react_to(const Event& event, const SurfaceFinder& surface, Pointer& pointer,
                  Session& session) {
  Reactor reactor{surface, pointer, session};
  std::visit(reactor, event);
  return std::move(reactor.reaction);
}

}  // namespace relief
