// The section "Views": where the camera is, and how it moves.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "viewer/input/shortcuts.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"

namespace relief {
namespace {

/// Buttons beside each other.
constexpr int kColumns = 4;

void standard_views(Navigator& navigator) {
  const float gap = 0.5F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 size{(ImGui::GetContentRegionAvail().x - (kColumns - 1) * gap) / kColumns, 0.0F};
  int column = 0;
  const auto button = [&](const std::string& name) {
    if (column++ % kColumns != 0) ImGui::SameLine(0.0F, gap);
    return ImGui::Button(name.c_str(), size);
  };
  for (const auto& [name, orbit] : kViews) {
    if (button(capitalised(name))) navigator.look_from(orbit);
  }
  if (button("Home")) navigator.home();
  help_for_last("The first view");
}

void up_row(Navigator& navigator) {
  std::vector<std::string> names{"As the scan has it"};
  std::size_t current = 0;
  for (const auto& [name, axis] : kAxes) {
    if (navigator.up_axis() == axis) current = names.size();
    names.emplace_back(name);
  }
  const auto chosen = choice_row("Up", "The axis that points up", names, current);
  if (chosen == 0U) navigator.set_up_axis(std::nullopt);
  if (chosen && *chosen > 0) navigator.set_up_axis(kAxes[*chosen - 1].value);
}

void orbit_row(Navigator& navigator) {
  std::vector<std::string> names;
  std::size_t current = 0;
  for (const auto& [name, style] : kOrbitStyles) {
    if (navigator.orbit_style() == style) current = names.size();
    names.push_back(capitalised(name));
  }
  const auto chosen = choice_row(
      "Orbit", "A turntable keeps the up axis upright; a trackball does not", names, current);
  if (chosen) navigator.set_orbit_style(kOrbitStyles[*chosen].value);
}

void lens_rows(Navigator& navigator) {
  const bool is_orthographic = navigator.camera().is_orthographic();
  const auto chosen =
      choice_row("Projection", nullptr, {"Perspective", "Orthographic"}, is_orthographic ? 1U : 0U);
  if (chosen) navigator.set_orthographic(*chosen == 1U);
  if (is_orthographic) return;
  std::optional<double> degrees = navigator.camera().vertical_fov_degrees;
  const double usual = Camera().vertical_fov_degrees;
  if (number_row(
          {"Field of view", "Vertical", {kMinFieldOfView, kMaxFieldOfView}, usual, "%.1f\xC2\xB0"},
          degrees))
    navigator.set_field_of_view(degrees.value_or(usual));
}

void begin_renaming(std::size_t index, const PanelContext& panel) {
  const std::string& name = panel.session.bookmarks.list()[index].name;
  auto& to = panel.state.new_name;
  to = {};
  std::copy_n(name.begin(), std::min(name.size(), to.size() - 1), to.begin());
  panel.state.renamed = index;
  panel.state.name_takes_keys = true;
}

void bookmark_menu(std::size_t index, const PanelContext& panel) {
  if (!ImGui::BeginPopup("menu")) return;
  Bookmarks& bookmarks = panel.session.bookmarks;
  if (ImGui::MenuItem("Rename")) begin_renaming(index, panel);
  if (ImGui::MenuItem("Replace by this view"))
    bookmarks.replace(index, panel.session.navigator.camera());
  if (ImGui::MenuItem("Move up", nullptr, false, index > 0)) bookmarks.move(index, index - 1);
  if (ImGui::MenuItem("Delete")) {
    bookmarks.remove(index);
    panel.state.renamed.reset();
  }
  ImGui::EndPopup();
}

void rename_field(std::size_t index, const PanelContext& panel) {
  ImGui::SetNextItemWidth(-1.0F);
  if (std::exchange(panel.state.name_takes_keys, false)) ImGui::SetKeyboardFocusHere();
  auto& name = panel.state.new_name;
  const bool entered =
      ImGui::InputText("##name", name.data(), name.size(),
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (entered) panel.session.bookmarks.rename(index, name.data());
  if (entered || ImGui::IsItemDeactivated()) panel.state.renamed.reset();
}

void bookmark_row(std::size_t index, const PanelContext& panel) {
  if (panel.state.renamed == index) return rename_field(index, panel);
  const Bookmarks& bookmarks = panel.session.bookmarks;
  const float menu = ImGui::GetFrameHeight();
  const float width = ImGui::GetContentRegionAvail().x - menu - ImGui::GetStyle().ItemSpacing.x;
  ImGui::AlignTextToFramePadding();
  if (ImGui::Selectable(bookmarks.list()[index].name.c_str(), bookmarks.selected() == index,
                        ImGuiSelectableFlags_AllowDoubleClick, {width, 0.0F})) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
      begin_renaming(index, panel);
    else
      go_to_bookmark(index, panel.session);
  }
  ImGui::SameLine();
  if (ImGui::Button("\xE2\x80\xA6", {menu, 0.0F})) ImGui::OpenPopup("menu");
  bookmark_menu(index, panel);
}

void bookmark_rows(const PanelContext& panel) {
  begin_row("Bookmarks", "Page up and page down go from one to the next");
  if (ImGui::Button("Add", {-1.0F, 0.0F})) add_bookmark(panel.session);
  help_for_last("Key: Ctrl + B");
  // Its size may change on the way.
  for (std::size_t index = 0; index < panel.session.bookmarks.size(); ++index) {
    ImGui::PushID(static_cast<int>(index));
    bookmark_row(index, panel);
    ImGui::PopID();
  }
}

}  // namespace

void show_views(const PanelContext& panel) {
  Navigator& navigator = panel.session.navigator;
  standard_views(navigator);
  up_row(navigator);
  orbit_row(navigator);
  lens_rows(navigator);
  bookmark_rows(panel);
}

}  // namespace relief
