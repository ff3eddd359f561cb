// All keys and gestures.
#include <imgui.h>

#include <array>
#include <utility>

#include "viewer/panels/panels.h"

namespace relief {
namespace {

constexpr std::array<std::pair<const char*, const char*>, 27> kKeys{
    {{"drag", "orbit about the point under the cursor"},
     {"right drag, Shift + drag", "pan"},
     {"Ctrl + drag", "look around"},
     {"Alt + drag", "roll"},
     {"wheel, pinch", "zoom towards the cursor"},
     {"W A S D, Q E", "fly; with Shift faster"},
     {"1 to 7", "front, back, left, right, top, bottom, iso"},
     {"Home", "the first view"},
     {"F", "frame all"},
     {"L", "level the horizon"},
     {"O", "orthographic"},
     {"Ctrl + B", "add a bookmark"},
     {"Page up, Page down", "the bookmark before, the next one"},
     {"C", "compare two looks"},
     {"M", "measure"},
     {"Backspace, Esc", "measuring: take a point back, give up"},
     {"Enter, double click", "end a polyline"},
     {"I, Shift + I", "inspect: the next view, the one before"},
     {"Tab", "hide the panels"},
     {"F11", "full screen"},
     {"Ctrl + O", "open a file"},
     {"Ctrl + S", "write a picture"},
     {"Ctrl + Q", "quit"},
     {"?", "this list"},
     {"drop a file", "open it"},
     {"right click on a slider", "its default"},
     {"Ctrl + click on a slider", "type a number"}}};

}  // namespace

void show_help(Session& session) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float width =
      static_cast<float>(session.window.x) / ImGui::GetIO().DisplayFramebufferScale.x;
  ImGui::SetNextWindowPos({viewport.Pos.x + 0.5F * width, viewport.Pos.y + 0.5F * viewport.Size.y},
                          ImGuiCond_Appearing, {0.5F, 0.5F});
  ImGui::Begin("Keys", &session.shows_help,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoCollapse);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.6F * ImGui::GetFontSize(), 2.0F});
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const auto& [key, effect] : kKeys) {
      ImGui::TableNextColumn();
      ImGui::TextColored({1.0F, 0.85F, 0.5F, 1.0F}, "%s", key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(effect);
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

}  // namespace relief
