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

/// Returns the indices of the points that no other point dominates, by increasing cost. A point
/// dominates another if it is no more expensive and no worse, and better in one of the two.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<PlotPoint>& points);

/// Returns the plot as SVG, with a logarithmic axis of cost. Points of the Pareto front are filled
/// and joined. Equal plots give equal text.
[[nodiscard]] std::string plot_as_svg(const Plot& plot);

}  // namespace relief::cli
