#include "viewer/panels/rows.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "common/image/srgb.h"

namespace relief {
namespace {

/// Of a label, in heights of the text.
constexpr float kLabelWidth = 8.6F;
constexpr float kHelpWidth = 22.0F;

ImGuiSliderFlags flags_of(const NumberRow& row) {
  return ImGuiSliderFlags_AlwaysClamp | (row.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

}  // namespace

void help_for_last(const char* text) {
  if (text == nullptr || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kHelpWidth * ImGui::GetFontSize());
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void begin_row(const char* label, const char* help) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  help_for_last(help);
  ImGui::SameLine(kLabelWidth * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1.0F);
}

bool number_row(const NumberRow& row, std::optional<double>& value) {
  begin_row(row.label, row.help);
  ImGui::PushID(row.label);
  double shown = value.value_or(row.usual);
  const bool moved = ImGui::SliderScalar("##value", ImGuiDataType_Double, &shown, &row.range.min,
                                         &row.range.max, row.format, flags_of(row));
  const bool takes_back = ImGui::IsItemClicked(ImGuiMouseButton_Right) && value.has_value();
  ImGui::PopID();
  if (takes_back)
    value.reset();
  else if (moved)
    value = shown;
  return moved || takes_back;
}

std::optional<std::size_t> choice_row(const char* label, const char* help,
                                      const std::vector<std::string>& choices,
                                      std::optional<std::size_t> current) {
  begin_row(label, help);
  ImGui::PushID(label);
  std::optional<std::size_t> chosen;
  const char* const shown = current ? choices[*current].c_str() : "";
  if (ImGui::BeginCombo("##choice", shown, ImGuiComboFlags_HeightLarge)) {
    for (std::size_t k = 0; k < choices.size(); ++k) {
      ImGui::PushID(static_cast<int>(k));
      if (ImGui::Selectable(choices[k].c_str(), current == k) && current != k) chosen = k;
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return chosen;
}

bool colour_row(const char* label, const char* help, glm::vec3& colour) {
  begin_row(label, help);
  ImGui::PushID(label);
  glm::vec3 shown(srgb_from_linear(colour.r), srgb_from_linear(colour.g),
                  srgb_from_linear(colour.b));
  const bool changed = ImGui::ColorEdit3("##colour", &shown.x, ImGuiColorEditFlags_Uint8);
  ImGui::PopID();
  if (changed) {
    colour = {linear_from_srgb(shown.r), linear_from_srgb(shown.g), linear_from_srgb(shown.b)};
  }
  return changed;
}

void show_faint(const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

void show_faint_wrapped(const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

std::string capitalised(std::string_view name) {
  std::string text(name);
  if (!text.empty())
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

}  // namespace relief
