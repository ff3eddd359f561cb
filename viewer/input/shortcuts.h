// Keys of the panels.
#pragma once

#include "viewer/session.h"
#include "viewer/window/events.h"

namespace relief {

/// Does what a key stands for. Returns whether it stands for something; `key` is GLFW's.
bool react_to_shortcut(int key, const Modifiers& modifiers, Session& session);

/// Begins a comparison of the look with itself, whose right side is then edited; or ends it, and
/// keeps the look left of the divider.
void toggle_comparison(Session& session);

/// Shows something else in place of the picture.
void choose_inspection(Inspection inspection, Session& session);

/// Adds the camera to the bookmarks.
void add_bookmark(Session& session);

/// Goes to a bookmark.
void go_to_bookmark(std::size_t index, Session& session);

}  // namespace relief
