// Scatter plots of quality against cost, written as SVG.
#pragma once

#include <string>
#include <vector>

namespace relief::cli {

/// One method. Cost above 0; both finite.
struct PlotPoint {
  std::string name;
  double cost = 1.0;
  double quality = 0.0;
  bool marked = false;  ///< drawn with a ring
};

/// A cost to compare with, drawn as a vertical line.
struct PlotLine {
  std::string name;
  double cost = 1.0;
};

struct PlotPanel {
  std::string title;
  std::string quality_label;
  std::vector<PlotPoint> points;
};

struct Plot {
  std::string title;
  std::string cost_label;
  std::vector<PlotPanel> panels;  ///< side by side, with the same axis of cost
  std::vector<PlotLine> lines;
};

/// Places in `points` of those that no other one beats: none is at most as dear and at least as
/// good, and better in one of the two. From the cheapest to the dearest.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points);

/// The plot, with a logarithmic axis of cost; points of the Pareto front are full and joined. The
/// same plot gives the same text.
[[nodiscard]] std::string plot_as_svg(const Plot& plot);

}  // namespace relief::cli
