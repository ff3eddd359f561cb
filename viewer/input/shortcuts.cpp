#include "viewer/input/shortcuts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <fmt/format.h>

namespace relief {
namespace {

bool react_to_control(int key, Session& session) {
  if (key == GLFW_KEY_B) {
    add_bookmark(session);
  } else if (key == GLFW_KEY_O) {
    session.asks_for_file = true;
  } else if (key == GLFW_KEY_S) {
    session.wants_picture = true;
  } else if (key == GLFW_KEY_Q) {
    session.wants_close = true;
  } else {
    return false;
  }
  return true;
}

void go_to_selected(std::optional<std::size_t> index, Session& session) {
  if (index) go_to_bookmark(*index, session);
}

}  // namespace

bool react_to_shortcut(int key, const Modifiers& modifiers, Session& session) {
  if (modifiers.control) return react_to_control(key, session);
  if (key == GLFW_KEY_PAGE_DOWN) {
    go_to_selected(session.bookmarks.select_next(), session);
  } else if (key == GLFW_KEY_PAGE_UP) {
    go_to_selected(session.bookmarks.select_previous(), session);
  } else if (key == GLFW_KEY_C) {
    toggle_comparison(session);
  } else if (key == GLFW_KEY_I) {
    if (session.scene != nullptr)
      choose_inspection(next_inspection(session.inspection, modifiers.shift ? -1 : 1), session);
  } else if (key == GLFW_KEY_F11) {
    session.wants_full_screen = !session.wants_full_screen;
  } else {
    return false;
  }
  return true;
}

void toggle_comparison(Session& session) {
  if (session.compared)
    session.compared.reset();
  else
    session.compared = session.look;
  session.edits_compared = session.compared.has_value();
  session.look_changed = true;
}

void choose_inspection(Inspection inspection, Session& session) {
  // Kernels of volumes and 3D Gaussians have neither patches nor fragments to look into.
  const bool has_kernels = session.scene != nullptr && session.scene->has_kernels();
  session.inspection = has_kernels ? Inspection::Picture : inspection;
  session.inspected.psnr_db.reset();
  session.look_changed = true;
}

void add_bookmark(Session& session) {
  session.bookmarks.add(fmt::format("view {}", session.bookmarks.size() + 1),
                        session.navigator.camera());
}

void go_to_bookmark(std::size_t index, Session& session) {
  session.bookmarks.select(index);
  session.navigator.go_to(session.bookmarks.list()[index].camera);
}

}  // namespace relief
