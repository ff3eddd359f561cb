// What is open, how far loading is, and how long frames take: a line at the window's lower edge.
#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>
#include <vector>

#include "viewer/panels/panels.h"

namespace relief {
namespace {

/// `more`: what the noun ends with unless there is one.
std::string counted(std::size_t count, const char* noun, const char* more = "s") {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : more);
}

/// What a scene consists of.
std::string text_of(const LoadedScene& scene) {
  std::vector<std::string> parts;
  std::size_t volumes = scene.volume ? 1 : 0;
  std::size_t gaussians = scene.gaussians ? scene.gaussians->size() : 0;
  if (scene.volumes) {
    for (const VolumePart& part : scene.volumes->list) {
      if (const auto* const cloud = std::get_if<GaussianCloud>(&part.what))
        gaussians += cloud->size();
      else
        ++volumes;
    }
  }
  const std::size_t patches = scene.patches.patches.size();
  if (!scene.has_kernels() || patches > 0) parts.push_back(counted(patches, "patch", "es"));
  if (volumes > 0) parts.push_back(counted(volumes, "volume"));
  if (gaussians > 0) parts.push_back(counted(gaussians, "Gaussian"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

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
  const JobProgress progress = session.document.progress();
  if (!progress.stage.empty()) {
    return progress.share ? fmt::format("{} {:.0f} %", progress.stage, 100.0 * *progress.share)
                          : progress.stage;
  }
  if (session.document.is_loading()) return "opening";
  if (session.is_preparing) return "preparing";
  if (session.picture_job != nullptr) {
    const JobProgress made = session.picture_job->progress();
    return fmt::format("{} {:.0f} %", session.picture_job->request().file.filename().string(),
                       100.0 * made.share.value_or(0.0));
  }
  if (session.scene == nullptr) return "nothing is shown";
  if (session.stream) {
    const StreamState& stream = *session.stream;
    if (stream.waiting > 0) return fmt::format("reading, {} parts left", stream.waiting);
    return fmt::format("{} of {} tiles, {:.1f} M samples", stream.shown_tiles, stream.tiles,
                       1e-6 * static_cast<double>(stream.shown_samples));
  }
  const std::string inspected = inspected_of(session.inspected);
  return fmt::format("{}{}{}", text_of(*session.scene), inspected.empty() ? "" : "   ", inspected);
}

/// What is under the cursor: position, patch, normal, colour.
std::string hovered_text(const Session& session) {
  if (!session.hovered || session.scene == nullptr) return {};
  const SurfacePoint& point = session.hovered->point;
  std::string text = format_position(point.position, session.scene->patches.spacing);
  if (!session.hovered->is_exact) return text + "  (single precision)";
  if (!point.patch) return text;
  text += fmt::format("   patch {}   normal {:.3f}, {:.3f}, {:.3f}", *point.patch + 1,
                      point.normal.x, point.normal.y, point.normal.z);
  if (point.colour) {
    const glm::u8vec3 colour = *point.colour;
    text += fmt::format("   #{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b);
  }
  return text;
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
  const std::string hovered = hovered_text(session);
  ImGui::TextUnformatted((hovered.empty() ? state_of(session) : hovered).c_str());
  const std::string frame =
      session.frame_ms > 0.0 ? fmt::format("{:.0f} ms   ", session.frame_ms) : std::string();
  const std::string right = frame + "? for keys";
  ImGui::SameLine(width - ImGui::CalcTextSize(right.c_str()).x - 12.0F);
  ImGui::TextUnformatted(right.c_str());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace relief
