#include "viewer/panels/panels.h"

namespace relief {

void show_panels(Session& session, PanelState& state, double now) {
  show_messages(session);
  show_measurements(session);
  if (session.compared && session.scene != nullptr) show_divider(session);
  show_legend(session);
  if (session.shows_help) show_help(session);
  take_picture_key({session, state, now});
  if (session.asks_for_file) session.shows_panels = true;
  if (!session.shows_panels) return;
  show_side_panel({session, state, now});
  show_status_bar(session);
}

}  // namespace relief
