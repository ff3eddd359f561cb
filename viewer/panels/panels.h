// The panels around the picture and over it.
#pragma once

#include "viewer/panels/panel_state.h"
#include "viewer/session.h"

namespace relief {

/// Returns how wide the side panel is in a window, both in pixels; 0 while it is hidden.
[[nodiscard]] int side_panel_width(const Session& session, int window);

/// Shows all panels that are open, and changes the session as the user asks. Between Gui::begin()
/// and Gui::end().
void show_panels(Session& session, PanelState& state, double now);

/// Parts of it, one file each.
void show_side_panel(const PanelContext& panel);
void show_measurements(const Session& session);  ///< over the picture
void show_divider(Session& session);
void show_status_bar(const Session& session);
void show_messages(Session& session);
void show_legend(const Session& session);
void show_help(Session& session);

/// Makes a picture if its key was pressed.
void take_picture_key(const PanelContext& panel);

/// How far a picture or film is, and a button that cancels it.
void show_job(Session& session);

/// Sections of the side panel.
void show_files(const PanelContext& panel);
void show_views(const PanelContext& panel);
void show_look(const PanelContext& panel);
void show_light(const PanelContext& panel);
void show_drawing(const PanelContext& panel);
void show_measuring(const PanelContext& panel);
void show_picture(const PanelContext& panel);
void show_film(const PanelContext& panel);
void show_comparison(const PanelContext& panel);
void show_inspection(const PanelContext& panel);

}  // namespace relief
