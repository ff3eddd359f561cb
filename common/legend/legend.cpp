#include "common/legend/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "common/legend/draw_text.h"
#include "common/legend/ticks.h"

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

/// Where the panel is, whole pixels.
struct Panel {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
};

Panel panel_in(LegendCorner corner, double width, double height, double margin,
               const Image& image) {
  Panel panel;
  panel.left = std::round(corner.is_left ? margin : image.width - margin - width);
  panel.top = std::round(corner.is_top ? margin : image.height - margin - height);
  panel.right = panel.left + std::round(width);
  panel.bottom = panel.top + std::round(height);
  return panel;
}

/// Counts the pixels under a panel that differ from the one in the image's corner, which nearly
/// always shows the background.
std::size_t count_hidden(const Panel& panel, LegendCorner corner, const Image& image) {
  const std::size_t x = corner.is_left ? 0 : image.width - 1;
  const std::size_t y = corner.is_top ? 0 : image.height - 1;
  const std::size_t background = y * image.width + x;
  std::size_t count = 0;
  for (auto j = static_cast<std::size_t>(panel.top); j < static_cast<std::size_t>(panel.bottom);
       ++j) {
    for (auto i = static_cast<std::size_t>(panel.left); i < static_cast<std::size_t>(panel.right);
         ++i) {
      const std::size_t pixel = j * image.width + i;
      count += std::ranges::any_of(image.channels, [&](const Channel& channel) {
        return channel.values[pixel] != channel.values[background];
      });
    }
  }
  return count;
}

/// What a legend is drawn on.
struct Canvas {
  Image& image;
  std::optional<LegendCorner>& corner;
  double em = 0.0;  ///< size of the text, pixels
};

/// Draws the panel for a content of this size, in ems, and the title. Returns where the content
/// begins, or nothing if there is no room.
std::optional<glm::dvec2> open_panel(const std::string& title, double width, double height,
                                     const Canvas& canvas, Painter& painter) {
  const double em = canvas.em;
  const Image& image = canvas.image;
  const double full_width = (std::max(width, text_width(title)) + 2.0 * kPadding) * em;
  const double full_height = (height + kLine + 2.0 * kPadding) * em;
  const double margin = kMargin * em;
  if (full_width > kMaxShare * image.width || full_height > image.height - 2.0 * margin)
    return std::nullopt;
  const auto panel_at = [&](LegendCorner corner) {
    return panel_in(corner, full_width, full_height, margin, image);
  };
  if (!canvas.corner) {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const LegendCorner corner :
         {LegendCorner{false, false}, {false, true}, {true, false}, {true, true}}) {
      const std::size_t hidden = count_hidden(panel_at(corner), corner, image);
      if (hidden >= fewest) continue;
      fewest = hidden;
      canvas.corner = corner;
    }
  }
  const Panel panel = panel_at(*canvas.corner);
  painter.fill(panel.left, panel.top, panel.right, panel.bottom, kPanel, kPanelOpacity);
  const double left = panel.left + kPadding * em;
  const double top = panel.top + kPadding * em;
  painter.text(title, left, top + kCapHeight * em, em, kText);
  return glm::dvec2(left, top + kLine * em);
}

bool draw_bar(const ColourScale& scale, const Canvas& canvas) {
  const double em = canvas.em;
  const double bar = std::floor(kBarShare * canvas.image.height / em);  // ems
  const int most = static_cast<int>(bar / kTicksApart) + 1;
  if (most < 2) return false;
  const std::vector<Tick> ticks = find_ticks(scale.low, scale.high, most);
  double widest = 0.0;
  for (const Tick& tick : ticks) widest = std::max(widest, text_width(tick.text));
  const double numbers = kBarWidth + kTickLength + kGap;
  Painter painter(canvas.image);
  const auto place =
      open_panel(title_of(scale), numbers + widest, bar + 0.5 * kLine, canvas, painter);
  if (!place) return false;
  const double top = std::round(place->y + 0.25 * kLine * em);
  const double bottom = std::round(top + bar * em);
  const double right = std::round(place->x + kBarWidth * em);
  const auto rows = static_cast<int>(bottom - top);
  for (int row = 0; row < rows; ++row) {
    const double y = top + row;
    const double share = (bottom - 0.5 - y) / (bottom - top);
    const glm::u8vec3 colour = scale.at(std::lerp(scale.low, scale.high, share));
    painter.fill(std::round(place->x), y, right, y + 1.0, linear_from_srgb8(colour), 1.0F);
  }
  const double thickness = std::max(1.0, std::round(em / 14.0));
  for (const Tick& tick : ticks) {
    const double share =
        scale.high > scale.low ? (tick.value - scale.low) / (scale.high - scale.low) : 0.5;
    const double y = std::lerp(bottom, top, share);
    const double line = std::clamp(std::round(y - 0.5 * thickness), top, bottom - thickness);
    painter.fill(right, line, right + kTickLength * em, line + thickness, kText, 1.0F);
    painter.text(tick.text, place->x + numbers * em, y + 0.5 * kCapHeight * em, em, kText);
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

bool draw_list(const ColourScale& scale, const Canvas& canvas) {
  const double em = canvas.em;
  const double room = kMaxShare * canvas.image.height / em - kLine - 2.0 * kPadding;
  const auto most = static_cast<std::size_t>(std::max(room / kLine, 0.0));
  if (most < 2) return false;
  const std::vector<Row> rows = rows_of(scale, most);
  double widest = 0.0;
  for (const Row& row : rows) widest = std::max(widest, text_width(row.text));
  const double texts = kBarWidth + kGap;
  Painter painter(canvas.image);
  const auto place = open_panel(title_of(scale), texts + widest,
                                kLine * static_cast<double>(rows.size()), canvas, painter);
  if (!place) return false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double top = place->y + (static_cast<double>(k) * kLine + 0.25) * em;
    const bool has_colour =
        k < scale.labels.size() && (k + 1 < rows.size() || rows.size() == scale.labels.size());
    if (has_colour) {
      painter.fill(std::round(place->x), std::round(top), std::round(place->x + kBarWidth * em),
                   std::round(top + em), linear_from_srgb8(rows[k].colour), 1.0F);
    }
    painter.text(rows[k].text, place->x + texts * em, top + (0.5 + 0.5 * kCapHeight) * em, em,
                 kText);
  }
  return true;
}

}  // namespace

bool draw_legend(const ColourScale& scale, Image& image, std::optional<LegendCorner>& corner) {
  const double smaller = std::min(image.width, image.height);
  for (const double em : {std::max(std::round(kTextShare * smaller), kMinText), kMinText}) {
    const Canvas canvas{image, corner, em};
    if (scale.is_label ? draw_list(scale, canvas) : draw_bar(scale, canvas)) return true;
  }
  return false;
}

}  // namespace relief
