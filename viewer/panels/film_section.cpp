// The section "Film": a camera path through the bookmarks, and the film along it.
#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"
#include "viewer/panels/save_field.h"
#include "viewer/picture_orders.h"

namespace relief {
namespace {

constexpr NumberChoice kLegSeconds{0.1, 60.0};
/// Of a bookmark's name in a row.
constexpr std::size_t kMostLetters = 16;

/// A name as a row's label, cut between characters of UTF-8.
std::string label_of_bookmark(const std::string& name) {
  if (name.size() <= kMostLetters) return name;
  std::size_t end = kMostLetters - 1;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return name.substr(0, end) + "\xE2\x80\xA6";
}

void leg_rows(Session& session) {
  Bookmarks& bookmarks = session.bookmarks;
  for (std::size_t k = 0; k + 1 < bookmarks.size(); ++k) {
    ImGui::PushID(static_cast<int>(k));
    std::optional<double> seconds = bookmarks.list()[k].seconds;
    const std::string label = label_of_bookmark(bookmarks.list()[k].name);
    const std::string help = fmt::format("Seconds from {} to {}", bookmarks.list()[k].name,
                                         bookmarks.list()[k + 1].name);
    if (number_row({label.c_str(), help.c_str(), kLegSeconds, kBookmarkSeconds, "%.1f s", true},
                   seconds))
      bookmarks.set_seconds(k, seconds.value_or(kBookmarkSeconds));
    ImGui::PopID();
  }
  const std::string last = label_of_bookmark(bookmarks.list().back().name);
  begin_row(last.c_str(), nullptr);
  show_faint(session.path.is_loop ? "back to the first" : "the end");
}

void rate_row(Session& session) {
  std::optional<double> rate = session.path.frames_per_second;
  if (number_row({"Frame rate", "Frames a second", kFrameRates, kUsualFrameRate, "%.0f", true},
                 rate))
    session.path.frames_per_second = rate.value_or(kUsualFrameRate);
}

void film_buttons(const PanelContext& panel) {
  Session& session = panel.session;
  const float gap = 0.5F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 size{(ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F, 0.0F};
  if (ImGui::Button(session.preview ? "Stop" : "Play", size)) toggle_preview(panel.now, session);
  help_for_last("Moves the camera along the path in the window");
  ImGui::SameLine(0.0F, gap);
  std::filesystem::path file = path_in(panel.state.film, session);
  if (ImGui::Button("Write film", size)) order_film(file, panel.now, session);
  help_for_last(
      ".mp4 and .webm by ffmpeg, .png and .exr as numbered frames. Size and background are those "
      "of the section Picture");
  ImGui::SameLine(0.0F, gap);
  file.replace_extension(".json");
  if (ImGui::Button("Write path", size)) write_path(file, panel.now, session);
  help_for_last(fmt::format("{}, for relief render --path", file.string()).c_str());
}

}  // namespace

void show_film(const PanelContext& panel) {
  Session& session = panel.session;
  const auto path = path_through(session.bookmarks, session.path);
  if (!path) return show_faint_wrapped(fmt::format("{}.", path.error().message).c_str());
  leg_rows(session);
  ImGui::Checkbox("Back to the first", &session.path.is_loop);
  rate_row(session);
  const double seconds = duration_of(*path);
  const auto cameras = film_cameras(*path, session.path.frames_per_second);
  show_faint(cameras ? fmt::format("{:.1f} s, {} frames", seconds, cameras->size()).c_str()
                     : cameras.error().message.c_str());
  show_save_field("##film", name_beside(session, ".mp4"), session, panel.state.film);
  film_buttons(panel);
  if (session.picture_job != nullptr && session.picture_job->request().is_film) show_job(session);
}

}  // namespace relief
