// The section "Picture": a picture of the view as a file, and the command that makes it.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"
#include "viewer/panels/save_field.h"
#include "viewer/picture_orders.h"

namespace relief {
namespace {

constexpr std::array<ImageSize, 3> kPictureSizes{{{1920, 1080}, {3840, 2160}, {4096, 4096}}};

/// A name that no file has; asked of the disk once for each picture.
const std::string& offered_name(const PanelContext& panel) {
  OfferedPicture& offered = panel.state.offered_picture;
  const auto& files = panel.session.document.files();
  const std::filesystem::path of = files.empty() ? "relief" : files.front();
  const bool is_busy = panel.session.picture_job != nullptr;
  const bool has_ended = std::exchange(offered.was_busy, is_busy) && !is_busy;
  if (offered.of == of && !has_ended) return offered.name;
  offered.of = of;
  const auto path = of.parent_path() / name_beside(panel.session, ".png");
  offered.name = free_path(path).filename().string();
  return offered.name;
}

void size_rows(Session& session) {
  std::vector<std::string> names{
      fmt::format("As the window, {} \xC3\x97 {}", session.window.x, session.window.y)};
  std::optional<std::size_t> current;
  if (!session.picture.size) current = 0;
  for (const ImageSize size : kPictureSizes) {
    const bool is_it = session.picture.size && session.picture.size->width == size.width &&
                       session.picture.size->height == size.height;
    if (is_it) current = names.size();
    names.push_back(fmt::format("{} \xC3\x97 {}", size.width, size.height));
  }
  names.emplace_back("Another");
  const auto chosen = choice_row("Size", "Of pictures and films, in pixels", names,
                                 current.value_or(names.size() - 1));
  if (chosen == 0U) session.picture.size.reset();
  if (chosen && *chosen > 0 && *chosen <= kPictureSizes.size())
    session.picture.size = kPictureSizes[*chosen - 1];
  if (chosen == names.size() - 1)
    session.picture.size = ImageSize{static_cast<std::uint32_t>(session.window.x),
                                     static_cast<std::uint32_t>(session.window.y)};
  if (!session.picture.size) return;
  std::array<int, 2> sides{static_cast<int>(session.picture.size->width),
                           static_cast<int>(session.picture.size->height)};
  begin_row("", nullptr);
  if (!ImGui::InputInt2("##sides", sides.data())) return;
  for (int& side : sides) side = std::clamp(side, 1, static_cast<int>(kMaxRenderSide));
  session.picture.size =
      ImageSize{static_cast<std::uint32_t>(sides[0]), static_cast<std::uint32_t>(sides[1])};
}

void copy_command(const PanelContext& panel) {
  const auto command =
      picture_command(path_in(panel.state.picture, panel.session), panel.now, panel.session);
  if (!command) return add_message(panel.session, command.error().message, true, panel.now);
  ImGui::SetClipboardText(command->c_str());
  add_message(panel.session, "The command is on the clipboard", false, panel.now);
}

}  // namespace

void show_job(Session& session) {
  if (session.picture_job == nullptr) return;
  PictureJob& job = *session.picture_job;
  const JobProgress progress = job.progress();
  const std::string text = job.is_cancelled()       ? std::string("Cancelling")
                           : progress.stage.empty() ? std::string("Beginning")
                                                    : progress.stage;
  show_faint_wrapped(fmt::format("{}: {}", job.request().file.filename().string(), text).c_str());
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float button = ImGui::CalcTextSize("Cancel").x + 2.0F * ImGui::GetStyle().FramePadding.x;
  ImGui::ProgressBar(static_cast<float>(progress.share.value_or(0.0)),
                     {ImGui::GetContentRegionAvail().x - button - gap, 0.0F});
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) job.cancel();
}

void take_picture_key(const PanelContext& panel) {
  if (!std::exchange(panel.session.wants_picture, false)) return;
  offer(offered_name(panel), panel.state.picture);
  order_picture(path_in(panel.state.picture, panel.session), panel.now, panel.session);
}

void show_picture(const PanelContext& panel) {
  Session& session = panel.session;
  size_rows(session);
  ImGui::Checkbox("Transparent background", &session.picture.is_transparent);
  show_save_field("##picture", offered_name(panel), session, panel.state.picture);
  const float gap = 0.5F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 size{0.5F * (ImGui::GetContentRegionAvail().x - gap), 0.0F};
  if (ImGui::Button("Write picture", size))
    order_picture(path_in(panel.state.picture, session), panel.now, session);
  help_for_last(session.compared
                    ? "PNG or EXR, of the look that is edited, not of both. Key: Ctrl + S"
                    : "PNG or EXR, by the name's ending. Key: Ctrl + S");
  ImGui::SameLine(0.0F, gap);
  if (ImGui::Button("Copy command", size)) copy_command(panel);
  help_for_last("The relief render command that makes this picture, to the byte");
  if (session.picture_job != nullptr && !session.picture_job->request().is_film) show_job(session);
}

}  // namespace relief
