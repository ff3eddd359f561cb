// The section "Measure": the tools, and what has been measured.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "viewer/measuring/measurement_file.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"
#include "viewer/panels/save_field.h"

namespace relief {
namespace {

constexpr int kToolColumns = 3;
constexpr std::array<MeasurementKind, 5> kKinds{MeasurementKind::Point, MeasurementKind::Distance,
                                                MeasurementKind::Polyline, MeasurementKind::Height,
                                                MeasurementKind::Angle};

const char* help_of(MeasurementKind kind) {
  switch (kind) {
    case MeasurementKind::Point:
      return "Coordinates of the surface";
    case MeasurementKind::Distance:
      return "The straight distance between two points";
    case MeasurementKind::Polyline:
      return "The length of a line through any number of points";
    case MeasurementKind::Height:
      return "The height difference of two points along the up axis";
    case MeasurementKind::Angle:
      return "The angle at the second of three points";
  }
  return "";
}

void tool_buttons(Session& session) {
  MeasuringTool& tool = session.measuring;
  const float gap = 0.5F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 size{(ImGui::GetContentRegionAvail().x - (kToolColumns - 1) * gap) / kToolColumns,
                    0.0F};
  int column = 0;
  for (const MeasurementKind kind : kKinds) {
    if (column++ % kToolColumns != 0) ImGui::SameLine(0.0F, gap);
    const bool is_chosen = tool.chosen() == kind;
    if (is_chosen)
      ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_SliderGrab));
    const bool clicked = ImGui::Button(capitalised(name_of(kind)).c_str(), size);
    if (is_chosen) ImGui::PopStyleColor();
    help_for_last(help_of(kind));
    if (!clicked) continue;
    if (is_chosen) {
      tool.put_away();
    } else {
      tool.choose(kind);
      session.last_tool = kind;
    }
  }
}

/// What to do next.
std::string hint_of(const Session& session) {
  const MeasuringTool& tool = session.measuring;
  if (session.scene == nullptr) return "There is no surface yet.";
  if (!tool.chosen()) return "Choose a tool, or press M.";
  const std::size_t count = tool.open_points().size();
  if (tool.chosen() == MeasurementKind::Polyline && count >= 2)
    return "Click on. Enter or a double click ends, Backspace takes a point back.";
  if (count == 0) return "Click a point of the surface. Esc puts the tool away.";
  return fmt::format("Click point {}. Backspace takes one back, Esc gives up.", count + 1);
}

/// All values of a measurement, as a line.
std::string values_text(const Measurement& measurement, glm::dvec3 up, double spacing) {
  std::string text = label_of(measurement, up, spacing);
  if (measurement.kind == MeasurementKind::Point) return text;
  const auto values = values_of(measurement, up);
  for (std::size_t k = 1; k < values.size(); ++k) {
    const std::string_view name =
        values[k].name == "horizontal_length" ? "horizontal" : values[k].name;
    text += fmt::format(", {} {}", name, format_length(values[k].value, spacing));
  }
  return text;
}

void name_field(std::size_t index, float width, MeasuringTool& tool) {
  std::array<char, 256> name{};
  const std::string& has = tool.list()[index].name;
  std::copy_n(has.begin(), std::min(has.size(), name.size() - 1), name.begin());
  ImGui::SetNextItemWidth(width);
  if (ImGui::InputText("##name", name.data(), name.size())) tool.rename(index, name.data());
}

/// Returns whether it is to be deleted.
bool measurement_row(std::size_t index, const PanelContext& panel) {
  Session& session = panel.session;
  const glm::dvec3 up = session.navigator.stance().up;
  const float button = ImGui::GetFrameHeight();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float copy = ImGui::CalcTextSize("Copy").x + 2.0F * ImGui::GetStyle().FramePadding.x;
  name_field(index, ImGui::GetContentRegionAvail().x - copy - button - 2.0F * gap,
             session.measuring);
  ImGui::SameLine();
  const Measurement& measurement = session.measuring.list()[index];
  if (ImGui::Button("Copy")) ImGui::SetClipboardText(copied_text(measurement, up).c_str());
  help_for_last(copied_text(measurement, up).c_str());
  ImGui::SameLine();
  const bool is_deleted = ImGui::Button("\xC3\x97", {button, 0.0F});
  help_for_last("Delete");
  const double spacing = session.scene == nullptr ? 0.0 : session.scene->patches.spacing;
  show_faint_wrapped(values_text(measurement, up, spacing).c_str());
  return is_deleted;
}

void write_list(const char* extension, const PanelContext& panel) {
  Session& session = panel.session;
  std::filesystem::path path = path_in(panel.state.measurements, session);
  path.replace_extension(extension);
  const MeasurementSource model{session.document.files().front().string(),
                                session.navigator.stance().up};
  const Status written = write_measurements(path, session.measuring.list(), model);
  add_message(session,
              written ? fmt::format("{}: written", path.string()) : written.error().message,
              !written, panel.now);
}

void export_rows(const PanelContext& panel) {
  ImGui::Dummy({0.0F, 0.2F * ImGui::GetFontSize()});
  show_save_field("##export", name_beside(panel.session, "-measurements.json"), panel.session,
                  panel.state.measurements);
  const float gap = 0.5F * ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 size{(ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F, 0.0F};
  if (ImGui::Button("Write JSON", size)) write_list(".json", panel);
  ImGui::SameLine(0.0F, gap);
  if (ImGui::Button("Write CSV", size)) write_list(".csv", panel);
  ImGui::SameLine(0.0F, gap);
  if (ImGui::Button("Clear list", size)) panel.session.measuring.clear();
}

}  // namespace

void show_measuring(const PanelContext& panel) {
  Session& session = panel.session;
  tool_buttons(session);
  show_faint_wrapped(hint_of(session).c_str());
  std::optional<std::size_t> deleted;
  for (std::size_t index = 0; index < session.measuring.list().size(); ++index) {
    ImGui::PushID(static_cast<int>(index));
    if (measurement_row(index, panel)) deleted = index;
    ImGui::PopID();
  }
  if (deleted) session.measuring.remove(*deleted);
  if (!session.measuring.list().empty() && !session.document.files().empty()) export_rows(panel);
}

}  // namespace relief
