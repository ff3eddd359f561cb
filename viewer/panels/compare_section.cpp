// The section "Compare": two looks beside a divider.
#include <imgui.h>

#include <utility>

#include "viewer/input/shortcuts.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"

namespace relief {
namespace {

void side_row(Session& session) {
  begin_row("Edit", "The side that the sections Look, Light and Drawing change");
  int side = session.edits_compared ? 1 : 0;
  ImGui::RadioButton("A, left", &side, 0);
  ImGui::SameLine();
  ImGui::RadioButton("B, right", &side, 1);
  session.edits_compared = side == 1;
}

void copy_row(Session& session) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 size{(ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F, 0.0F};
  if (ImGui::Button("Copy A to B", size)) {
    *session.compared = session.look;
    session.look_changed = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("Copy B to A", size)) {
    session.look = *session.compared;
    session.look_changed = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("Swap", size)) {
    std::swap(session.look, *session.compared);
    session.look_changed = true;
  }
}

}  // namespace

void show_comparison(const PanelContext& panel) {
  Session& session = panel.session;
  bool compares = session.compared.has_value();
  if (ImGui::Checkbox("Two looks beside a divider", &compares)) toggle_comparison(session);
  if (!session.compared) return show_faint_wrapped("B begins as A is. Key: C");
  side_row(session);
  copy_row(session);
}

}  // namespace relief
