// Sentences for the user, in the window's upper middle.
#include <imgui.h>

#include "viewer/panels/panels.h"

namespace relief {
namespace {

/// Of the picture's width.
constexpr float kWidth = 0.6F;

}  // namespace

void show_messages(Session& session) {
  if (session.messages.empty()) return;
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float width =
      static_cast<float>(session.window.x) / ImGui::GetIO().DisplayFramebufferScale.x;
  ImGui::SetNextWindowPos({viewport.Pos.x + 0.5F * width, viewport.Pos.y + 12.0F}, ImGuiCond_Always,
                          {0.5F, 0.0F});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  ImGui::Begin("messages", nullptr, kFlags);
  ImGui::PushTextWrapPos(kWidth * width);
  for (const Message& message : session.messages) {
    const ImVec4 colour =
        message.is_error ? ImVec4(1.0F, 0.55F, 0.45F, 1.0F) : ImVec4(0.9F, 0.9F, 0.9F, 1.0F);
    ImGui::TextColored(colour, "%s", message.text.c_str());
  }
  ImGui::PopTextWrapPos();
  if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(0)) session.messages.clear();
  ImGui::End();
}

}  // namespace relief
