#include "cli/trade/trade_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <variant>

#include "cli/plot/markup.h"
#include "cli/plot/plot_axis.h"

namespace relief::cli {
namespace {

// Pixels.
constexpr double kPlotWidth = 600.0;
constexpr double kPlotHeight = 400.0;
constexpr double kPlotLeft = 62.0;
constexpr double kPlotRight = 16.0;
constexpr double kPlotTop = 44.0;
constexpr double kPlotBottom = 48.0;
/// Between the labels of an axis of cost.
constexpr double kLabelRoom = 44.0;

/// Colours that differ for people who see few colours, too (Okabe and Ito).
constexpr std::array<const char*, 8> kPainterColours{"#0072b2", "#e69f00", "#cc79a7", "#009e73",
                                                     "#56b4e9", "#d55e00", "#8c6d31", "#777777"};

bool is_size(const TradeQuantity& quantity) {
  return &quantity == &file_size() || &quantity == &gpu_size();
}

/// A plot's frame and its two axes.
class Canvas {
 public:
  Canvas(const std::vector<TradeRow>& rows, const TradePlane& plane) : plane_(plane) {
    std::vector<double> costs;
    std::vector<double> qualities;
    for (const TradeRow& row : rows) {
      const auto cost = plane.cost.of(row);
      const auto quality = plane.quality.of(row);
      if (!cost || !quality) continue;
      costs.push_back(std::log10(*cost));
      qualities.push_back(*quality);
    }
    cost_ = axis_of(costs, 0.3);
    quality_ = axis_of(qualities, 1.0);
  }

  [[nodiscard]] double x_of(double cost) const {
    return kPlotLeft + cost_.fraction(std::log10(cost)) * (kPlotWidth - kPlotLeft - kPlotRight);
  }
  [[nodiscard]] double y_of(double quality) const {
    const double share = quality_.fraction(quality);
    const double from_top = plane_.less_is_better() ? share : 1.0 - share;
    return kPlotTop + from_top * (kPlotHeight - kPlotTop - kPlotBottom);
  }

  [[nodiscard]] std::string axes() const {
    std::string svg;
    const double bottom = kPlotHeight - kPlotBottom;
    const double right = kPlotWidth - kPlotRight;
    double labelled = -kLabelRoom;
    for (const double tick : logarithmic_ticks(cost_)) {
      const double x = x_of(tick);
      svg += fmt::format(R"(<path class="tg" d="M{0:.1f} {1}V{2}"/>)", x, kPlotTop, bottom);
      if (x - labelled < kLabelRoom) continue;
      labelled = x;
      svg += fmt::format(R"(<text class="tb" x="{:.1f}" y="{}">{}</text>)", x, bottom + 17.0,
                         readable(plane_.cost, tick));
    }
    for (const double tick : linear_ticks(quality_)) {
      const double y = y_of(tick);
      svg += fmt::format(R"(<path class="tg" d="M{0} {1:.1f}H{2}"/>)", kPlotLeft, y, right);
      svg += fmt::format(R"(<text class="ts" x="{}" y="{:.1f}">{:g}</text>)", kPlotLeft - 7.0,
                         y + 4.0, tick);
    }
    svg += fmt::format(R"(<path class="tf" d="M{0} {1}H{2}V{3}H{0}Z"/>)", kPlotLeft, kPlotTop,
                       right, bottom);
    svg += fmt::format(R"(<text class="tt" x="{}" y="18">{}</text>)", kPlotLeft, plane_.title);
    svg += fmt::format(R"(<text class="tl" x="{}" y="36">{}{}</text>)", kPlotLeft,
                       plane_.quality.label,
                       plane_.less_is_better() ? ", less is better and upward" : "");
    svg += fmt::format(R"(<text class="tb" x="{}" y="{}">{}</text>)", 0.5 * (kPlotLeft + right),
                       kPlotHeight - 10.0, plane_.cost.label);
    return svg;
  }

 private:
  const TradePlane& plane_;
  Axis cost_;
  Axis quality_;
};

std::string point_of(const Canvas& canvas, const TradeRow& row, std::size_t number,
                     const TradePlane& plane, bool is_best, std::size_t painter) {
  const double cost = *plane.cost.of(row);
  const double quality = *plane.quality.of(row);
  return fmt::format(
      R"(<circle class="{}" data-row="{}" cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}"><title>{}: {}, {}</title></circle>)",
      is_best ? "tp ton" : "tp", number, canvas.x_of(cost), canvas.y_of(quality),
      is_best ? 5.0 : 3.5, colour_of_painter(painter), as_markup(row.name),
      readable(plane.cost, cost), readable(plane.quality, quality));
}

/// The presets' names, each on the side where the frame has room. That of `exact`, which is often
/// near `balanced`, is above its point.
std::string preset_labels(const Canvas& canvas, const std::vector<TradeRow>& rows,
                          const TradePlane& plane) {
  std::string svg;
  for (const TradeRow& row : rows) {
    const auto cost = plane.cost.of(row);
    const auto quality = plane.quality.of(row);
    if (!row.quality || !cost || !quality) continue;
    const double x = canvas.x_of(*cost);
    const double y = canvas.y_of(*quality);
    const bool is_right = x > kPlotWidth - 100.0;
    svg += fmt::format(R"(<circle class="tr" cx="{:.1f}" cy="{:.1f}" r="9"/>)", x, y);
    svg += fmt::format(R"(<text class="tn" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)",
                       is_right ? x - 12.0 : x + 12.0,
                       *row.quality == Quality::Exact ? y - 9.0 : y + 14.0,
                       is_right ? "end" : "start", relief::name_of(kQualities, *row.quality));
  }
  return svg;
}

std::string with_commas(double value) {
  const std::string digits = fmt::format("{:.0f}", value);
  std::string text;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    if (k > 0 && (digits.size() - k) % 3 == 0) text += ',';
    text += digits[k];
  }
  return text;
}

}  // namespace

std::string painter_of(const std::vector<TradeKnob>& knobs, const TradeRow& row) {
  const OptionValues options = options_of(knobs, row.setting, TradeStage::Render);
  std::string name = std::get<std::string>(options.at("engine"));
  if (const auto primitive = options.find("primitive"); primitive != options.end())
    name += " " + std::get<std::string>(primitive->second);
  return name;
}

std::vector<std::string> painters_of(const std::vector<TradeKnob>& knobs,
                                     const std::vector<TradeRow>& rows) {
  // In the order of the settings' choices, which is that of the registry.
  std::vector<const TradeRow*> sorted;
  sorted.reserve(rows.size());
  for (const TradeRow& row : rows) sorted.push_back(&row);
  const auto way = [&knobs](const TradeRow* row) {
    std::vector<std::size_t> choices;
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      if (knobs[k].stage == TradeStage::Render && !knobs[k].is_ordered)
        choices.push_back(row->setting[k]);
    }
    return choices;
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&way](const auto* a, const auto* b) { return way(a) < way(b); });
  std::vector<std::string> painters;
  for (const TradeRow* const row : sorted) {
    std::string painter = painter_of(knobs, *row);
    if (std::find(painters.begin(), painters.end(), painter) == painters.end())
      painters.push_back(std::move(painter));
  }
  return painters;
}

std::string colour_of_painter(std::size_t n) {
  return kPainterColours[std::min(n, kPainterColours.size() - 1)];
}

std::string trade_plot(const std::vector<TradeKnob>& knobs, const std::vector<TradeRow>& rows,
                       const TradePlane& plane) {
  const Canvas canvas(rows, plane);
  const std::vector<std::size_t> front = front_of(rows, plane);
  const std::vector<std::string> painters = painters_of(knobs, rows);
  std::string svg =
      fmt::format(R"(<svg class="trade" viewBox="0 0 {0} {1}" width="{0}" height="{1}">)",
                  kPlotWidth, kPlotHeight);
  svg += canvas.axes();
  const auto draw = [&](std::size_t k, bool is_best) {
    if (!plane.cost.of(rows[k]) || !plane.quality.of(rows[k])) return;
    const auto painter = std::find(painters.begin(), painters.end(), painter_of(knobs, rows[k]));
    svg += point_of(canvas, rows[k], k, plane, is_best,
                    static_cast<std::size_t>(painter - painters.begin()));
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (std::find(front.begin(), front.end(), k) == front.end()) draw(k, false);
  }
  std::string corners;
  for (const std::size_t k : front) {
    corners +=
        fmt::format("{}{:.1f} {:.1f}", corners.empty() ? "M" : "L",
                    canvas.x_of(*plane.cost.of(rows[k])), canvas.y_of(*plane.quality.of(rows[k])));
  }
  if (!corners.empty()) svg += fmt::format(R"(<path class="tfront" d="{}"/>)", corners);
  for (const std::size_t k : front) draw(k, true);
  return svg + preset_labels(canvas, rows, plane) + "</svg>\n";
}

const char* trade_plot_style() {
  return ".trade text { font: 12px sans-serif; fill: #222 }\n"
         ".trade .tt { font-weight: bold; font-size: 14px }\n"
         ".trade .tl { fill: #555 }\n"
         ".trade .tb { text-anchor: middle }\n"
         ".trade .ts { text-anchor: end }\n"
         ".trade .tn { font-weight: bold; paint-order: stroke; stroke: #fff; stroke-width: 3px }\n"
         ".trade .tg { stroke: #e6e6e6; fill: none }\n"
         ".trade .tf { stroke: #444; fill: none }\n"
         ".trade .tfront { stroke: #111; stroke-width: 1.5; fill: none }\n"
         ".trade .tp { fill-opacity: 0.45 }\n"
         ".trade .ton { fill-opacity: 1; stroke: #111; stroke-width: 1.2 }\n"
         ".trade .tr { fill: none; stroke: #c00; stroke-width: 2; pointer-events: none }\n"
         ".trade .tn { pointer-events: none }\n"
         ".trade .same { stroke: #c00; stroke-width: 3; fill-opacity: 1 }\n";
}

std::string readable(const TradeQuantity& quantity, double value) {
  if (is_size(quantity)) {
    if (value >= 1e6) return fmt::format("{:.3g} MB", value / 1e6);
    return value >= 1e3 ? fmt::format("{:.3g} kB", value / 1e3)
                        : fmt::format("{} bytes", with_commas(value));
  }
  if (&quantity == &frame_time())
    return value >= 100.0 ? with_commas(value) + " ms" : fmt::format("{:.3g} ms", value);
  if (&quantity == &conversion_time()) return fmt::format("{:.3g} s", value);
  if (&quantity == &normal_error()) return fmt::format("{:.2f} degrees", value);
  return fmt::format("{:.2f} dB", value);
}

}  // namespace relief::cli
