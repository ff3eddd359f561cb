// What the colours of an inspection or of a scalar stand for, in the picture's lower right corner.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "common/legend/ticks.h"
#include "common/scalars/colour_scale.h"
#include "renderer/geometry/cells/levels.h"
#include "viewer/inspecting/inspection_colours.h"
#include "viewer/panels/panels.h"

namespace relief {
namespace {

constexpr ImU32 kTickColour = IM_COL32(200, 204, 210, 255);
constexpr int kBarSteps = 64;
constexpr int kMostTicks = 6;
constexpr int kFewestTicks = 2;
constexpr std::size_t kMostLabels = 16;
/// In ems.
constexpr float kBarWidth = 16.0F;
constexpr float kBarHeight = 0.8F;

ImU32 colour_of(glm::u8vec3 colour) {
  return IM_COL32(colour.r, colour.g, colour.b, 255);
}

std::string text_of_tick(const Tick& tick, double high, bool is_open) {
  return is_open && tick.value >= high ? "\xE2\x89\xA5 " + tick.text : tick.text;
}

/// As many ticks as a bar has room for.
std::vector<Tick> fitting_ticks(double low, double high, float width) {
  std::vector<Tick> ticks;
  for (int most = kMostTicks; most >= kFewestTicks; --most) {
    ticks = find_ticks(low, high, most);
    float needed = 0.0F;
    for (const Tick& tick : ticks)
      needed += ImGui::CalcTextSize(tick.text.c_str()).x + 1.5F * ImGui::GetFontSize();
    if (needed < width) break;
  }
  return ticks;
}

/// A bar of a map with numbers below it; `is_open`: larger values have the last colour.
void bar(ColourMap map, double low, double high, bool is_open) {
  const float em = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = kBarWidth * em;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int k = 0; k < kBarSteps; ++k) {
    const float left = at.x + width * static_cast<float>(k) / kBarSteps;
    const float right = at.x + width * static_cast<float>(k + 1) / kBarSteps;
    list.AddRectFilled({left, at.y}, {right, at.y + kBarHeight * em},
                       colour_of(colour_at(map, (k + 0.5) / kBarSteps)));
  }
  for (const Tick& tick : fitting_ticks(low, high, width)) {
    const double share = high > low ? (tick.value - low) / (high - low) : 0.5;
    const std::string text = text_of_tick(tick, high, is_open);
    const float size = ImGui::CalcTextSize(text.c_str()).x;
    const float x = at.x + width * static_cast<float>(share);
    list.AddLine({x, at.y + kBarHeight * em}, {x, at.y + 1.1F * em}, kTickColour);
    list.AddText({std::clamp(x - 0.5F * size, at.x, at.x + width - size), at.y + 1.2F * em},
                 kTickColour, text.c_str());
  }
  ImGui::Dummy({width, 2.3F * em});
}

void box(glm::u8vec3 colour, const std::string& text) {
  const float em = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.1F * em}, {at.x + em, at.y + 0.9F * em},
                                            colour_of(colour));
  ImGui::Dummy({1.2F * em, em});
  ImGui::SameLine();
  ImGui::TextUnformatted(text.c_str());
}

void level_boxes() {
  for (std::uint32_t level = 0; level < kMaxLevels; ++level) {
    const std::string every =
        level == 0 ? "0, all samples" : fmt::format("{}, every {}th", level, 1U << level);
    box(level_colour(level), level == 1 ? "1, every 2nd" : every);
  }
  box(kAfarColour, "drawn from afar");
}

/// What the scan is coloured by: as pictures have it (common/legend).
void scalar(const ColourScale& scale) {
  ImGui::TextUnformatted(title_of(scale).c_str());
  if (!scale.is_label) return bar(scale.map, scale.low, scale.high, false);
  const std::size_t shown =
      scale.labels.size() > kMostLabels ? kMostLabels - 1 : scale.labels.size();
  for (const std::uint32_t label : std::span(scale.labels).first(shown))
    box(scale.at(label), label_text(scale, label));
  if (shown < scale.labels.size()) ImGui::Text("and %zu more", scale.labels.size() - shown);
}

bool has_legend(const Session& session) {
  switch (session.inspection) {
    case Inspection::Levels:
    case Inspection::Overdraw:
      return true;
    case Inspection::Picture:
    case Inspection::Distance:
      return session.scene->colours.has_value();
    case Inspection::Difference:
      return session.inspected.psnr_db.has_value();
    default:
      return false;
  }
}

void content(const Session& session) {
  const Inspection what = session.inspection;
  if (what == Inspection::Levels) {
    ImGui::TextUnformatted("Level of detail");
    level_boxes();
  } else if (what == Inspection::Overdraw) {
    ImGui::TextUnformatted("Fragments a pixel");
    bar(kFragmentMap, 0.0, kMostFragments, true);
  } else if (what == Inspection::Difference) {
    ImGui::TextUnformatted("Difference in 8-bit steps");
    bar(kDifferenceMap, 0.0, kMostDifference, true);
  } else if (what == Inspection::Picture) {
    scalar(*session.scene->colours);
  } else {
    const ColourScale& scale = *session.scene->colours;
    ImGui::TextUnformatted("Distance to the points, in the scan's unit");
    bar(scale.map, scale.low, scale.high, true);
    const std::string range = fmt::format("2 % to 98 %: {:.3g} to {:.3g}", scale.low, scale.high);
    ImGui::TextUnformatted(range.c_str());
  }
}

}  // namespace

void show_legend(const Session& session) {
  if (session.scene == nullptr || !has_legend(session)) return;
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  const float density = ImGui::GetIO().DisplayFramebufferScale.x;
  const float em = ImGui::GetFontSize();
  const float status = session.shows_panels ? ImGui::GetFrameHeight() : 0.0F;
  const ImVec2 corner{
      viewport.Pos.x + static_cast<float>(session.window.x) / density - 0.8F * em,
      viewport.Pos.y + static_cast<float>(session.window.y) / density - status - 0.8F * em};
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {1.0F, 1.0F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;
  // A window of its own for each, as large as its text.
  const std::string name = fmt::format("legend {}", static_cast<int>(session.inspection));
  ImGui::Begin(name.c_str(), nullptr, kFlags);
  content(session);
  ImGui::End();
}

}  // namespace relief
