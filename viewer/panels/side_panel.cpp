// The panel at the window's right edge: sections that open and close.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "viewer/panels/panels.h"

namespace relief {
namespace {

/// In pixels of a screen whose content scale is 1.
constexpr double kPanelWidth = 336.0;

struct Section {
  const char* title;
  bool is_open_at_first;
  void (*show)(const PanelContext& panel);
};

constexpr std::array<Section, 10> kSections{{{"Files", true, show_files},
                                             {"Views", true, show_views},
                                             {"Look", true, show_look},
                                             {"Inspect", true, show_inspection},
                                             {"Light", false, show_light},
                                             {"Drawing", false, show_drawing},
                                             {"Compare", false, show_comparison},
                                             {"Measure", false, show_measuring},
                                             {"Picture", false, show_picture},
                                             {"Film", false, show_film}}};

void show_section(const Section& section, const PanelContext& panel) {
  auto& open = panel.session.preferences.sections;
  const auto known = open.find(section.title);
  bool is_asked_for = false;
  const bool was_open = known == open.end() ? section.is_open_at_first : known->second;
  if (panel.session.asks_for_section == section.title) {
    // In the first frame what is in it has no height yet, so that it cannot be scrolled to.
    if (std::exchange(panel.state.is_scrolling, !panel.state.is_scrolling))
      panel.session.asks_for_section.clear();
    open.insert_or_assign(section.title, true);
    is_asked_for = true;
  }
  ImGui::SetNextItemOpen(is_asked_for || was_open, ImGuiCond_Always);
  const bool is_open = ImGui::CollapsingHeader(section.title);
  if (is_asked_for) ImGui::SetScrollHereY(0.0F);
  if (is_open != was_open) open.insert_or_assign(section.title, is_open);
  if (!is_open) return;
  ImGui::PushID(section.title);
  section.show(panel);
  ImGui::Dummy({0.0F, 0.3F * ImGui::GetFontSize()});
  ImGui::PopID();
}

}  // namespace

int side_panel_width(const Session& session, int window) {
  if (!session.shows_panels) return 0;
  return std::min(static_cast<int>(std::lround(kPanelWidth * session.scale)), window / 2);
}

void show_side_panel(const PanelContext& panel) {
  if (std::exchange(panel.session.asks_for_file, false)) {
    panel.session.preferences.sections.insert_or_assign(kSections.front().title, true);
    panel.state.file.takes_keys = true;
  }
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float density = ImGui::GetIO().DisplayFramebufferScale.x;
  const auto pixels = static_cast<float>(
      side_panel_width(panel.session, static_cast<int>(density * viewport.Size.x)));
  const float width = pixels / density;
  ImGui::SetNextWindowPos({viewport.Pos.x + viewport.Size.x - width, viewport.Pos.y});
  ImGui::SetNextWindowSize({width, viewport.Size.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  // The picture ends where the panel begins: nothing is behind it.
  ImVec4 colour = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  colour.w = 1.0F;
  ImGui::PushStyleColor(ImGuiCol_WindowBg, colour);
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus;
  ImGui::Begin("side panel", nullptr, kFlags);
  for (const Section& section : kSections) show_section(section, panel);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace relief
