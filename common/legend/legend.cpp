#include "common/legend/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "common/legend/draw_text.h"
#include "common/legend/ticks.h"
#include "common/scalars/scalar_names.h"

namespace relief {
namespace {

/// Text is this share of the image's smaller side, and never smaller than kMinText pixels an em:
/// below that, digits are hard to tell apart.
constexpr double kTextShare = 1.0 / 42.0;
constexpr double kMinText = 11.0;
/// Largest part of the image's width and height that a legend takes.
constexpr double kMaxShare = 0.6;
constexpr double kBarShare = 0.4;  ///< height of the bar, of the image

/// Lengths in ems.
constexpr double kMargin = 1.0;   ///< from the panel to the image's border
constexpr double kPadding = 0.8;  ///< from the panel's border to what it holds
constexpr double kLine = 1.5;     ///< from a base line to the next
constexpr double kBarWidth = 1.2;
constexpr double kTickLength = 0.35;
constexpr double kGap = 0.4;
constexpr double kTicksApart = 2.4;  ///< least distance of two ticks

const glm::vec3 kText(0.9F);
const glm::vec3 kPanel(0.012F);
constexpr float kPanelOpacity = 0.9F;

struct Row {
  glm::u8vec3 colour{0};
  std::string text;
};

std::string title_of(const ColourScale& scale) {
  std::string title = scale.name;
  std::ranges::replace(title, '_', ' ');
  return title;
}

std::string label_text(const ColourScale& scale, std::uint32_t label) {
  const auto name = scale.name == "classification" ? las_class_name(label) : std::string_view();
  return name.empty() ? fmt::format("{}", label) : fmt::format("{}  {}", label, name);
}

/// One corner of a legend, in pixels, and its text size.
struct Place {
  double left = 0.0;
  double top = 0.0;
  double em = 0.0;
};

/// Draws the panel for a content of this size, in ems, and the title. Returns where the content
/// begins, or nothing if there is no room.
std::optional<Place> open_panel(const std::string& title, double width, double height, double em,
                                const Image& image, Painter& painter) {
  const double full_width = (std::max(width, text_width(title)) + 2.0 * kPadding) * em;
  const double full_height = (height + kLine + 2.0 * kPadding) * em;
  if (full_width > kMaxShare * image.width || full_height > image.height - 2.0 * kMargin * em)
    return std::nullopt;
  const double right = std::round(image.width - kMargin * em);
  const double bottom = std::round(image.height - kMargin * em);
  const Place panel{std::round(right - full_width), std::round(bottom - full_height), em};
  painter.fill(panel.left, panel.top, right, bottom, kPanel, kPanelOpacity);
  const double left = panel.left + kPadding * em;
  const double top = panel.top + kPadding * em;
  painter.text(title, left, top + kCapHeight * em, em, kText);
  return Place{left, top + kLine * em, em};
}

bool draw_bar(const ColourScale& scale, double em, Image& image) {
  const double bar = std::floor(kBarShare * image.height / em);  // ems
  const int most = static_cast<int>(bar / kTicksApart) + 1;
  if (most < 2) return false;
  const std::vector<Tick> ticks = find_ticks(scale.low, scale.high, most);
  double widest = 0.0;
  for (const Tick& tick : ticks) widest = std::max(widest, text_width(tick.text));
  const double numbers = kBarWidth + kTickLength + kGap;
  Painter painter(image);
  const auto place =
      open_panel(title_of(scale), numbers + widest, bar + 0.5 * kLine, em, image, painter);
  if (!place) return false;
  const double top = std::round(place->top + 0.25 * kLine * em);
  const double bottom = std::round(top + bar * em);
  const double right = std::round(place->left + kBarWidth * em);
  for (double y = top; y < bottom; y += 1.0) {
    const double share = (bottom - 0.5 - y) / (bottom - top);
    const glm::u8vec3 colour = scale.at(std::lerp(scale.low, scale.high, share));
    painter.fill(std::round(place->left), y, right, y + 1.0, linear_from_srgb8(colour), 1.0F);
  }
  const double thickness = std::max(1.0, std::round(em / 14.0));
  for (const Tick& tick : ticks) {
    const double share =
        scale.high > scale.low ? (tick.value - scale.low) / (scale.high - scale.low) : 0.5;
    const double y = std::lerp(bottom, top, share);
    const double line = std::clamp(std::round(y - 0.5 * thickness), top, bottom - thickness);
    painter.fill(right, line, right + kTickLength * em, line + thickness, kText, 1.0F);
    painter.text(tick.text, place->left + numbers * em, y + 0.5 * kCapHeight * em, em, kText);
  }
  return true;
}

/// The rows of a list, at most `most`; the last one counts those that are left out.
std::vector<Row> rows_of(const ColourScale& scale, std::size_t most) {
  std::vector<Row> rows;
  const bool all = scale.labels.size() <= most;
  const std::size_t shown = all ? scale.labels.size() : most - 1;
  for (const std::uint32_t label : std::span(scale.labels).first(shown))
    rows.push_back({scale.at(label), label_text(scale, label)});
  if (!all) rows.push_back({{}, fmt::format("and {} more", scale.labels.size() - shown)});
  return rows;
}

bool draw_list(const ColourScale& scale, double em, Image& image) {
  const double room = kMaxShare * image.height / em - kLine - 2.0 * kPadding;
  const auto most = static_cast<std::size_t>(std::max(room / kLine, 0.0));
  if (most < 2) return false;
  const std::vector<Row> rows = rows_of(scale, most);
  double widest = 0.0;
  for (const Row& row : rows) widest = std::max(widest, text_width(row.text));
  const double texts = kBarWidth + kGap;
  Painter painter(image);
  const auto place = open_panel(title_of(scale), texts + widest,
                                kLine * static_cast<double>(rows.size()), em, image, painter);
  if (!place) return false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double top = place->top + (static_cast<double>(k) * kLine + 0.25) * em;
    const bool has_colour =
        k < scale.labels.size() && (k + 1 < rows.size() || rows.size() == scale.labels.size());
    if (has_colour) {
      painter.fill(std::round(place->left), std::round(top),
                   std::round(place->left + kBarWidth * em), std::round(top + em),
                   linear_from_srgb8(rows[k].colour), 1.0F);
    }
    painter.text(rows[k].text, place->left + texts * em, top + (0.5 + 0.5 * kCapHeight) * em, em,
                 kText);
  }
  return true;
}

}  // namespace

bool draw_legend(const ColourScale& scale, Image& image) {
  const double smaller = std::min(image.width, image.height);
  for (const double em : {std::max(std::round(kTextShare * smaller), kMinText), kMinText}) {
    if (scale.is_label ? draw_list(scale, em, image) : draw_bar(scale, em, image)) return true;
  }
  return false;
}

}  // namespace relief
