#include "viewer/panels/panels.h"

namespace relief {

void show_panels(Session& session, double now) {
  show_messages(session, now);
  if (session.shows_help) show_help(session);
  if (!session.shows_panels) return;
  show_status_bar(session);
}

}  // namespace relief
