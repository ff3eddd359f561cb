// The section "Inspect": what is shown in place of the picture.
#include <imgui.h>

#include <iterator>
#include <string>
#include <vector>

#include "viewer/input/shortcuts.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"

namespace relief {

void show_inspection(const PanelContext& panel) {
  Session& session = panel.session;
  if (session.scene == nullptr) return show_faint("There is no surface yet.");
  if (session.scene->has_kernels())
    return show_faint_wrapped("Volumes and 3D Gaussians are shown as a picture only.");
  std::vector<std::string> names;
  names.reserve(std::size(kInspections));
  for (const InspectionText& text : kInspections) names.emplace_back(text.name);
  const auto chosen =
      choice_row("Show", "What is shown in place of the picture. Keys: I, Shift + I", names,
                 static_cast<std::size_t>(session.inspection));
  if (chosen) choose_inspection(static_cast<Inspection>(*chosen), session);
  show_faint_wrapped(text_of(session.inspection).help);
}

}  // namespace relief
