// From preferences to a session and back.
#pragma once

#include "viewer/session.h"

namespace relief {

/// Gives a new session what is remembered.
void apply_preferences(Preferences preferences, Session& session);

/// Shows the bookmarks of the first open file, and keeps those of the one before.
void follow_bookmarks(Session& session);

/// Puts the open files into the recent ones, and the settings into their file. `window`: its size
/// in pixels. Fails if they can't be written; there may be nowhere to write them, which is no
/// failure.
Status remember_files(Session& session, glm::ivec2 window);

/// Puts the settings into their file, likewise.
Status remember_settings(Session& session, glm::ivec2 window);

}  // namespace relief
