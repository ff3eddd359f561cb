// The panels over the picture.
#pragma once

#include "viewer/session.h"

namespace relief {

/// Shows all panels that are open, and changes the session as the user asks. Between Gui::begin()
/// and Gui::end().
void show_panels(Session& session, double now);

/// Parts of it, one file each.
void show_status_bar(const Session& session);
void show_messages(Session& session, double now);
void show_help(Session& session);

}  // namespace relief
