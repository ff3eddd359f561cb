// What is open, how far loading is, and how long frames take: a line at the window's lower edge.
#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "viewer/panels/panels.h"

namespace relief {
namespace {

std::string state_of(const Session& session) {
  if (session.document.files().empty()) return "drop a file here to open it";
  const LoadProgress progress = session.document.progress();
  if (!progress.stage.empty()) {
    return progress.share ? fmt::format("{} {:.0f} %", progress.stage, 100.0 * *progress.share)
                          : progress.stage;
  }
  if (session.document.is_loading()) return "opening";
  if (session.scene == nullptr) return "nothing is shown";
  if (session.stream) {
    const StreamState& stream = *session.stream;
    if (stream.waiting > 0) return fmt::format("reading, {} parts left", stream.waiting);
    return fmt::format("{} of {} tiles, {:.1f} M samples", stream.shown_tiles, stream.tiles,
                       1e-6 * static_cast<double>(stream.shown_samples));
  }
  const PatchModel& patches = session.scene->patches;
  return fmt::format("{} patches", patches.patches.size());
}

}  // namespace

void show_status_bar(const Session& session) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float height = ImGui::GetFrameHeight();
  ImGui::SetNextWindowPos({viewport.Pos.x, viewport.Pos.y + viewport.Size.y - height});
  ImGui::SetNextWindowSize({viewport.Size.x, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0F, 3.0F});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoNav;
  ImGui::Begin("status", nullptr, kFlags);
  ImGui::TextUnformatted(state_of(session).c_str());
  const std::string right = fmt::format("{:.0f} ms   ? for keys", session.frame_ms);
  ImGui::SameLine(viewport.Size.x - ImGui::CalcTextSize(right.c_str()).x - 12.0F);
  ImGui::TextUnformatted(right.c_str());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace relief
