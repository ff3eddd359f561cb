// Pictures and films of what a window shows: what is asked for, and what becomes of it.
#pragma once

#include <filesystem>
#include <string>

#include "common/error.h"
#include "viewer/session.h"

namespace relief {

/// Begins to make a picture of the view, as the session's choices for pictures have it. Says in a
/// message why not, if so.
void order_picture(const std::filesystem::path& file, double now, Session& session);

/// The same of a film along the session's bookmarks.
void order_film(const std::filesystem::path& file, double now, Session& session);

/// Writes that path.
void write_path(const std::filesystem::path& file, double now, Session& session);

/// Returns the `relief render` command that makes order_picture()'s picture, and says in a message
/// what it cannot say.
Result<std::string> picture_command(const std::filesystem::path& file, double now,
                                    Session& session);

/// Says what has become of a picture, once it is there. Returns whether it is.
bool take_picture(double now, Session& session);

/// Begins to move the camera along the bookmarks; or ends that.
void toggle_preview(double now, Session& session);

/// Lets it go on for some seconds. Returns whether the camera has moved.
bool play(double seconds, Session& session);

}  // namespace relief
