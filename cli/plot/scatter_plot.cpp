#include "cli/plot/scatter_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "cli/plot/markup.h"
#include "cli/plot/plot_axis.h"

namespace relief::cli {
namespace {

// Pixels.
constexpr double kPanelWidth = 560.0;
constexpr double kPanelHeight = 420.0;
constexpr double kLeft = 64.0;  ///< of a panel's frame, for its axis
constexpr double kRight = 24.0;
constexpr double kTop = 76.0;
constexpr double kBottom = 56.0;
constexpr double kLetter = 6.2;  ///< width of a letter of the labels, about
constexpr double kLine = 13.0;   ///< height of a label

struct Box {
  double x0, y0, x1, y1;

  [[nodiscard]] bool overlaps(const Box& b) const {
    return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1;
  }
  [[nodiscard]] bool within(const Box& b) const {
    return x0 >= b.x0 && x1 <= b.x1 && y0 >= b.y0 && y1 <= b.y1;
  }
};

double width_of(const std::string& label) {
  return kLetter * static_cast<double>(label.size());
}

Axis cost_axis(const Plot& plot) {
  std::vector<double> logs;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotPoint& point : panel.points) logs.push_back(std::log10(point.cost));
  }
  for (const PlotLine& line : plot.lines) logs.push_back(std::log10(line.cost));
  Axis axis = axis_of(logs, 0.4);
  axis.max += 0.35 * (axis.max - axis.min);  // for the labels, which are to the right
  return axis;
}

Axis quality_axis(const PlotPanel& panel) {
  std::vector<double> values;
  for (const PlotPoint& point : panel.points) values.push_back(point.quality);
  return axis_of(values, 1.0);
}

/// Draws one panel.
class Panel {
 public:
  Panel(const PlotPanel& panel, const Axis& cost, double left)
      : panel_(panel),
        cost_(cost),
        quality_(quality_axis(panel)),
        frame_{left + kLeft, kTop, left + kPanelWidth - kRight, kTop + kPanelHeight} {}

  std::string draw(const Plot& plot) {
    draw_axes(plot.cost_label);
    for (const PlotLine& line : plot.lines) draw_line(line);
    const std::vector<std::size_t> front = pareto_front(panel_.points);
    draw_front(front);
    for (const PlotPoint& point : panel_.points) {
      const auto [x, y] = position_of(point);
      taken_.push_back({x - 7.0, y - 7.0, x + 7.0, y + 7.0});
    }
    for (std::size_t k = 0; k < panel_.points.size(); ++k)
      draw_point(panel_.points[k], std::find(front.begin(), front.end(), k) != front.end());
    return std::move(svg_);
  }

 private:
  [[nodiscard]] double x_of(double cost) const {
    return frame_.x0 + cost_.fraction(std::log10(cost)) * (frame_.x1 - frame_.x0);
  }
  [[nodiscard]] double y_of(double quality) const {
    return frame_.y1 - quality_.fraction(quality) * (frame_.y1 - frame_.y0);
  }
  [[nodiscard]] std::array<double, 2> position_of(const PlotPoint& point) const {
    return {x_of(point.cost), y_of(point.quality)};
  }

  void line(double x0, double y0, double x1, double y1, const char* kind) {
    svg_ += fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)",
                        kind, x0, y0, x1, y1) +
            "\n";
  }
  void text(double x, double y, const char* kind, const std::string& words) {
    svg_ += fmt::format(R"(<text class="{}" x="{:.1f}" y="{:.1f}">{}</text>)", kind, x, y,
                        as_markup(words)) +
            "\n";
  }

  void draw_axes(const std::string& cost_label) {
    for (const double tick : logarithmic_ticks(cost_)) {
      line(x_of(tick), frame_.y0, x_of(tick), frame_.y1, "grid");
      text(x_of(tick), frame_.y1 + 18.0, "below", fmt::format("{:g}", tick));
    }
    for (const double tick : linear_ticks(quality_)) {
      line(frame_.x0, y_of(tick), frame_.x1, y_of(tick), "grid");
      text(frame_.x0 - 8.0, y_of(tick) + 4.0, "beside", fmt::format("{:g}", tick));
    }
    svg_ +=
        fmt::format(R"(<rect class="frame" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)",
                    frame_.x0, frame_.y0, frame_.x1 - frame_.x0, frame_.y1 - frame_.y0) +
        "\n";
    const double middle = 0.5 * (frame_.x0 + frame_.x1);
    text(middle, frame_.y1 + 42.0, "below", cost_label);
    text(middle, frame_.y0 - 10.0, "title", panel_.title);
    text(frame_.x0 - 40.0, frame_.y0 - 10.0, "axis", panel_.quality_label);
  }

  void draw_line(const PlotLine& compared) {
    const double x = x_of(compared.cost);
    line(x, frame_.y0, x, frame_.y1, "compared");
    text(x + 4.0, frame_.y0 + kLine, "compared-name", compared.name);
    taken_.push_back({x, frame_.y0, x + 4.0 + width_of(compared.name), frame_.y0 + kLine + 4.0});
  }

  void draw_front(const std::vector<std::size_t>& front) {
    if (front.size() < 2) return;
    std::string corners;
    for (const std::size_t k : front) {
      const auto [x, y] = position_of(panel_.points[k]);
      corners += fmt::format("{:.1f},{:.1f} ", x, y);
    }
    svg_ += fmt::format(R"(<polyline class="front" points="{}"/>)", corners) + "\n";
  }

  void draw_point(const PlotPoint& point, bool best) {
    const auto [x, y] = position_of(point);
    svg_ += fmt::format(R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="4.5"/>)",
                        best ? "best" : "point", x, y) +
            "\n";
    if (point.marked)
      svg_ += fmt::format(R"(<circle class="ring" cx="{:.1f}" cy="{:.1f}" r="8"/>)", x, y) + "\n";
    const Box label = find_label_box(x, y, width_of(point.name));
    const bool before = label.x1 < x;  // with another font it still ends there
    svg_ += fmt::format(R"(<text class="{}" text-anchor="{}" x="{:.1f}" y="{:.1f}">{}</text>)",
                        best ? "best-label" : "label", before ? "end" : "start",
                        before ? label.x1 : label.x0, label.y1 - 3.0, as_markup(point.name)) +
            "\n";
  }

  /// Returns the free box for a label that is nearest to its point.
  Box find_label_box(double x, double y, double width) {
    Box first{};
    for (int step = 0; step < 12; ++step) {
      const double away = 0.5 * kLine * step;
      for (const double dy : {away, -away}) {
        for (const double dx : {11.0, -11.0 - width, -0.5 * width}) {
          const Box box{x + dx, y + dy - 0.5 * kLine, x + dx + width, y + dy + 0.5 * kLine};
          if (first.x1 == 0.0) first = box;
          const bool free = box.within(frame_) &&
                            std::none_of(taken_.begin(), taken_.end(),
                                         [&box](const Box& other) { return box.overlaps(other); });
          if (!free) continue;
          taken_.push_back(box);
          return box;
        }
      }
    }
    return first;
  }

  const PlotPanel& panel_;
  Axis cost_;
  Axis quality_;
  Box frame_;
  std::vector<Box> taken_;
  std::string svg_;
};

constexpr const char* kStyle =
    "<style>\n"
    "text { font-family: sans-serif; font-size: 12px; fill: #222 }\n"
    ".heading { font-size: 15px; font-weight: bold }\n"
    ".title { font-weight: bold; text-anchor: middle }\n"
    ".below { text-anchor: middle }\n"
    ".axis { fill: #555 }\n"
    ".beside { text-anchor: end }\n"
    ".label { font-size: 11px }\n"
    ".best-label { font-size: 11px; font-weight: bold }\n"
    ".compared-name { font-size: 11px; fill: #777 }\n"
    ".grid { stroke: #e4e4e4 }\n"
    ".compared { stroke: #999; stroke-dasharray: 5 4 }\n"
    ".frame { fill: none; stroke: #444 }\n"
    ".front { fill: none; stroke: #c0392b; stroke-width: 1.5 }\n"
    ".point { fill: white; stroke: #2c5d8a; stroke-width: 1.5 }\n"
    ".best { fill: #c0392b; stroke: #c0392b }\n"
    ".ring { fill: none; stroke: #222 }\n"
    "</style>\n";

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto beats = [](const PlotPoint& a, const PlotPoint& b) {
    return a.cost <= b.cost && a.quality >= b.quality && (a.cost < b.cost || a.quality > b.quality);
  };
  std::erase_if(order, [&](std::size_t k) {
    return std::any_of(points.begin(), points.end(),
                       [&](const PlotPoint& other) { return beats(other, points[k]); });
  });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].cost < points[b].cost; });
  return order;
}

std::string plot_as_svg(const Plot& plot) {
  const double width = kPanelWidth * static_cast<double>(plot.panels.size());
  const double height = kTop + kPanelHeight + kBottom;
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{:.0f}" height="{:.0f}" viewBox="0 0 {:.0f} {:.0f}">)",
      width, height, width, height);
  svg += fmt::format("\n{}<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n", kStyle);
  svg += fmt::format("<text class=\"heading\" x=\"{:.1f}\" y=\"28\">{}</text>\n", kLeft,
                     as_markup(plot.title));
  const Axis cost = cost_axis(plot);
  double left = 0.0;
  for (const PlotPanel& panel : plot.panels) {
    svg += Panel(panel, cost, left).draw(plot);
    left += kPanelWidth;
  }
  return svg + "</svg>\n";
}

}  // namespace relief::cli
