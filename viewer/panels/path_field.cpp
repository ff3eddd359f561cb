#include "viewer/panels/path_field.h"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "viewer/choices/path_completion.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

void put(std::string_view text, PathField& field) {
  const std::size_t length = std::min(text.size(), field.text.size() - 1);
  std::copy_n(text.begin(), length, field.text.begin());
  field.text[length] = '\0';
}

/// Puts the longest common start of all completions in place of what is typed.
int complete(ImGuiInputTextCallbackData* data) {
  const auto& field = *static_cast<const PathField*>(data->UserData);
  const std::string start = common_start(field.completions);
  if (start.size() <= static_cast<std::size_t>(data->BufTextLen)) return 0;
  data->DeleteChars(0, data->BufTextLen);
  data->InsertChars(0, start.c_str());
  return 0;
}

/// The last part of a path, and the slash of a folder.
const char* name_in(const std::string& path) {
  const std::size_t slash = path.rfind('/', path.size() - 2);
  return path.c_str() + (slash == std::string::npos ? 0 : slash + 1);
}

/// Returns the path that was clicked.
std::optional<std::string> show_completions(const PathField& field) {
  std::optional<std::string> clicked;
  ImGui::Indent(0.5F * ImGui::GetFontSize());
  for (const std::string& path : field.completions) {
    if (ImGui::Selectable(name_in(path))) clicked = path;
  }
  ImGui::Unindent(0.5F * ImGui::GetFontSize());
  return clicked;
}

}  // namespace

std::optional<fs::path> show_path_field(const PathFieldStyle& style, PathField& field) {
  ImGui::PushID(style.id);
  if (std::exchange(field.takes_keys, false)) {
    ImGui::SetKeyboardFocusHere();
    ImGui::SetScrollHereY();
  }
  ImGui::SetNextItemWidth(-1.0F);
  constexpr ImGuiInputTextFlags kFlags =
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion;
  const std::string before = field.text.data();
  const bool entered = ImGui::InputTextWithHint("##path", style.hint, field.text.data(),
                                                field.text.size(), kFlags, complete, &field);
  const bool is_active = ImGui::IsItemActive();
  const std::string typed = field.text.data();
  if (typed != before || ImGui::IsItemActivated()) {
    field.completions =
        typed.empty() ? std::vector<std::string>() : complete_path(typed, style.accepts);
    field.is_open = true;
  }
  std::optional<fs::path> taken;
  const auto take = [&](const std::string& text) {
    put(text, field);
    if (text.ends_with('/')) {  // a folder: go on in it
      field.completions = complete_path(text, style.accepts);
      field.takes_keys = true;
      return;
    }
    field.is_open = false;
    if (!text.empty()) taken = typed_path(text);
  };
  if (entered) take(typed);
  // A click on one of the list ends the typing before it is seen to be a click.
  if (field.is_open && !field.completions.empty()) {
    if (const auto clicked = show_completions(field)) take(*clicked);
  }
  if (!is_active && !field.takes_keys && ImGui::IsMouseReleased(ImGuiMouseButton_Left))
    field.is_open = false;
  ImGui::PopID();
  return taken;
}

void clear(PathField& field) {
  field = {};
}

}  // namespace relief
