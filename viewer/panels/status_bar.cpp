// What is open, how far loading is, and how long frames take: a line at the window's lower edge.
#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>

#include "viewer/panels/panels.h"

namespace relief {
namespace {

/// What an inspection has found.
std::string inspected_of(const InspectionState& state) {
  if (state.truth_share) return fmt::format("trace rays {:.0f} %", 100.0 * *state.truth_share);
  if (state.psnr_db)
    return std::isinf(*state.psnr_db)
               ? fmt::format("no difference to {}", state.truth)
               : fmt::format("PSNR {:.1f} dB against {}", *state.psnr_db, state.truth);
  if (state.fragments_a_pixel)
    return fmt::format("{:.2f} fragments a covered pixel", *state.fragments_a_pixel);
  return {};
}

std::string state_of(const Session& session) {
  if (session.document.files().empty()) return "drop a file here to open it";
  const LoadProgress progress = session.document.progress();
  if (!progress.stage.empty()) {
    return progress.share ? fmt::format("{} {:.0f} %", progress.stage, 100.0 * *progress.share)
                          : progress.stage;
  }
  if (session.document.is_loading()) return "opening";
  if (session.scene == nullptr) return "nothing is shown";
  const PatchModel& patches = session.scene->patches;
  const std::string inspected = inspected_of(session.inspected);
  return fmt::format("{} patches{}{}", patches.patches.size(), inspected.empty() ? "" : "   ",
                     inspected);
}

}  // namespace

void show_status_bar(const Session& session) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float height = ImGui::GetFrameHeight();
  ImGui::SetNextWindowPos({viewport.Pos.x, viewport.Pos.y + viewport.Size.y - height});
  const float width =
      static_cast<float>(session.window.x) / ImGui::GetIO().DisplayFramebufferScale.x;
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0F, 3.0F});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  ImGui::Begin("status", nullptr, kFlags);
  ImGui::TextUnformatted(state_of(session).c_str());
  const std::string frame =
      session.frame_ms > 0.0 ? fmt::format("{:.0f} ms   ", session.frame_ms) : std::string();
  const std::string right = frame + "? for keys";
  ImGui::SameLine(width - ImGui::CalcTextSize(right.c_str()).x - 12.0F);
  ImGui::TextUnformatted(right.c_str());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace relief
