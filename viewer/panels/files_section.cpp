// The section "Files": what is open, and how to open more.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "viewer/choices/text_of.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/path_field.h"
#include "viewer/panels/rows.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// How often the disk is asked whether recent files are there: a network may be slow.
constexpr double kDiskSeconds = 2.0;

std::optional<std::uintmax_t> bytes_of(const fs::path& file, const PanelContext& panel) {
  FileFacts& facts = panel.state.files;
  if (facts.since < 0.0 || panel.now - facts.since > kDiskSeconds) {
    facts.bytes.clear();
    facts.since = panel.now;
  }
  const auto known = facts.bytes.find(file);
  if (known != facts.bytes.end()) return known->second;
  std::error_code gone;
  const std::uintmax_t bytes = fs::file_size(file, gone);
  const auto found = gone ? std::nullopt : std::optional(bytes);
  facts.bytes.emplace(file, found);
  return found;
}

void open(const std::vector<fs::path>& files, bool beside, const PanelContext& panel) {
  Session& session = panel.session;
  const Status opened = beside ? session.document.add(files, session.look)
                               : session.document.open(files, session.look);
  if (!opened) add_message(session, opened.error().message, true, panel.now);
  panel.state.files.since = -1.0;
}

void close(const fs::path& file, const PanelContext& panel) {
  std::vector<fs::path> left = panel.session.document.files();
  std::erase(left, file);
  if (left.empty())
    panel.session.closes_files = true;
  else
    open(left, false, panel);
}

/// A name that is cut where `right` begins, and its whole path as help.
void name_text(const fs::path& file, float right) {
  const std::string name = file.filename().string();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(at, {at.x + right, at.y + ImGui::GetFrameHeight()}, true);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name.c_str());
  ImGui::PopClipRect();
  help_for_last(file.string().c_str());
}

/// Returns whether it is to be closed.
bool file_row(const fs::path& file, const PanelContext& panel) {
  const auto bytes = bytes_of(file, panel);
  std::error_code ignored;
  const char* const unsized = fs::is_directory(file, ignored) ? "folder" : "not there";
  const std::string size = bytes ? size_text(*bytes) : std::string(unsized);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float button = ImGui::GetFrameHeight();
  const float start = ImGui::GetCursorPosX();
  const float end = start + ImGui::GetContentRegionAvail().x - button;
  const float size_at = end - gap - ImGui::CalcTextSize(size.c_str()).x;
  name_text(file, size_at - gap - start);
  ImGui::SameLine(size_at);
  show_faint(size.c_str());
  ImGui::SameLine(end);
  const bool closes = ImGui::Button("\xC3\x97", {button, 0.0F});
  help_for_last("Close");
  return closes;
}

void open_files(const PanelContext& panel) {
  const std::vector<fs::path> files = panel.session.document.files();
  for (const fs::path& file : files) {
    ImGui::PushID(file.c_str());
    if (file_row(file, panel)) close(file, panel);
    ImGui::PopID();
  }
}

void fact(const char* label, const std::string& text) {
  show_faint(label);
  ImGui::SameLine(5.2F * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
}

void extent_facts(const Bounds& bounds) {
  if (bounds.empty()) return;
  const glm::dvec3 size = bounds.max - bounds.min;
  fact("Extent", extent_text(size));
  fact("From", position_text(bounds.min, size));
  fact("To", position_text(bounds.max, size));
}

void scene_facts(const PanelContext& panel) {
  const Session& session = panel.session;
  const bool is_one = session.document.files().size() == 1;
  if (session.points_read > 0 && is_one) fact("Points", count_text(session.points_read));
  if (session.scene == nullptr) return;
  const PatchModel& patches = session.scene->patches;
  SceneFacts& facts = panel.state.scene;
  if (facts.scene.lock() != session.scene) facts = {session.scene, count_samples(patches)};
  if (!patches.patches.empty()) {
    fact("Patches", count_text(patches.patches.size()));
    fact("Samples", count_text(facts.samples));
  }
  extent_facts(patches.bounds);
}

void recent_files(const PanelContext& panel) {
  const std::vector<fs::path> recent = panel.session.preferences.recent_files;
  const auto& files = panel.session.document.files();
  bool is_first = true;
  for (const fs::path& file : recent) {
    if (std::find(files.begin(), files.end(), file) != files.end()) continue;
    if (std::exchange(is_first, false)) show_faint("Recent");
    const bool is_there = bytes_of(file, panel).has_value();
    ImGui::PushID(file.c_str());
    ImGui::BeginDisabled(!is_there);
    if (ImGui::Selectable(file.filename().c_str())) open({file}, panel.state.adds_file, panel);
    ImGui::EndDisabled();
    help_for_last(
        (is_there ? file.string() : fmt::format("{} is not there any more", file.string()))
            .c_str());
    ImGui::PopID();
  }
}

bool may_be_opened(const fs::path& /*file*/) {
  return true;  // what a file is, its content says
}

}  // namespace

void show_files(const PanelContext& panel) {
  open_files(panel);
  scene_facts(panel);
  const auto typed =
      show_path_field({"file", "Path of a file to open", may_be_opened}, panel.state.file);
  if (!panel.session.document.files().empty())
    ImGui::Checkbox("Add to the open files", &panel.state.adds_file);
  recent_files(panel);
  if (!typed) return;
  open({*typed}, panel.state.adds_file, panel);
  clear(panel.state.file);
}

}  // namespace relief
