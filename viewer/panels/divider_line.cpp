// The line between two looks: its handle, and what the looks differ in.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "viewer/choices/differences.h"
#include "viewer/panels/panels.h"

namespace relief {
namespace {

constexpr std::size_t kMostDifferences = 4;

constexpr ImU32 kLine = IM_COL32(255, 255, 255, 230);
constexpr ImU32 kLineHovered = IM_COL32(255, 217, 128, 255);
constexpr ImU32 kBehindText = IM_COL32(20, 21, 24, 205);
constexpr ImU32 kText = IM_COL32(240, 240, 240, 255);
constexpr ImU32 kFaintText = IM_COL32(170, 174, 180, 255);
constexpr ImU32 kEdited = IM_COL32(255, 217, 128, 255);

struct Line {
  std::string what;
  std::string value;
};

struct Labels {
  std::vector<Line> left{{"", "A"}};
  std::vector<Line> right{{"", "B"}};
};

Labels labels_of(const Session& session) {
  Labels labels;
  if (session.scene == nullptr) return labels;
  const auto first = settings_of(session, session.look);
  const auto second = settings_of(session, *session.compared);
  if (!first || !second) return labels;
  const auto differences = differences_of({session.look, *first}, {*session.compared, *second});
  const std::size_t shown = std::min(differences.size(), kMostDifferences);
  for (std::size_t k = 0; k < shown; ++k) {
    const std::string what = differences[k].what + "  ";
    labels.left.push_back({what, differences[k].first});
    labels.right.push_back({what, differences[k].second});
  }
  if (shown == differences.size()) return labels;
  const Line more{fmt::format("and {} more", differences.size() - shown), ""};
  labels.left.push_back(more);
  labels.right.push_back(more);
  return labels;
}

float width_of(const Line& line) {
  return ImGui::CalcTextSize(line.what.c_str()).x + ImGui::CalcTextSize(line.value.c_str()).x;
}

/// Lines in a box whose upper corner at the divider is `at`.
void draw_lines(ImDrawList& list, const std::vector<Line>& lines, ImVec2 at, bool is_left,
                bool is_edited) {
  const float em = ImGui::GetFontSize();
  const float margin = 0.5F * em;
  float width = 0.0F;
  for (const Line& line : lines) width = std::max(width, width_of(line));
  const float height = 1.25F * em * static_cast<float>(lines.size());
  const float left = is_left ? at.x - width - 2.0F * margin : at.x;
  list.AddRectFilled({left, at.y}, {left + width + 2.0F * margin, at.y + height + margin},
                     kBehindText, 0.35F * em);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const float x = left + margin + (is_left ? width - width_of(lines[k]) : 0.0F);
    const float y = at.y + 0.4F * margin + 1.25F * em * static_cast<float>(k);
    const float what = ImGui::CalcTextSize(lines[k].what.c_str()).x;
    list.AddText({x, y}, kFaintText, lines[k].what.c_str());
    list.AddText({x + what, y}, k == 0 && is_edited ? kEdited : kText, lines[k].value.c_str());
  }
}

/// Two arrows in a disc, halfway down.
void draw_handle(ImDrawList& list, ImVec2 at, ImU32 colour) {
  const float em = ImGui::GetFontSize();
  list.AddCircleFilled(at, 0.95F * em, kBehindText, 32);
  list.AddCircle(at, 0.95F * em, colour, 32, 0.1F * em);
  for (const float side : {-1.0F, 1.0F}) {
    const float x = at.x + side * 0.22F * em;
    list.AddTriangleFilled({x + side * 0.4F * em, at.y}, {x, at.y - 0.32F * em},
                           {x, at.y + 0.32F * em}, colour);
  }
}

}  // namespace

void show_divider(Session& session) {
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float density = ImGui::GetIO().DisplayFramebufferScale.x;
  const float em = ImGui::GetFontSize();
  const float width = static_cast<float>(session.window.x) / density;
  const float height = static_cast<float>(session.window.y) / density;
  const float x = viewport.Pos.x + static_cast<float>(session.divider.share) * width;
  const bool is_lit = session.divider.is_hovered || session.divider.is_held;
  if (is_lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const ImU32 colour = is_lit ? kLineHovered : kLine;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(viewport.Pos, {viewport.Pos.x + width, viewport.Pos.y + height});
  list.AddLine({x, viewport.Pos.y}, {x, viewport.Pos.y + height}, kBehindText, 0.3F * em);
  list.AddLine({x, viewport.Pos.y}, {x, viewport.Pos.y + height}, colour, 0.12F * em);
  draw_handle(list, {x, viewport.Pos.y + 0.5F * height}, colour);
  const Labels labels = labels_of(session);
  const float top = viewport.Pos.y + 0.7F * em;
  draw_lines(list, labels.left, {x - 0.7F * em, top}, true, !session.edits_compared);
  draw_lines(list, labels.right, {x + 0.7F * em, top}, false, session.edits_compared);
  list.PopClipRect();
}

}  // namespace relief
