// The plots of `relief bench`.
#include "cli/plot/scatter_plot.h"

#include <gtest/gtest.h>

#include "cli/plot/plot_axis.h"

namespace relief::cli {
namespace {

using Places = std::vector<std::size_t>;

std::vector<PlotPoint> points(const std::vector<std::pair<double, double>>& values) {
  std::vector<PlotPoint> all;
  for (const auto& [cost, quality] : values)
    all.push_back({"p" + std::to_string(all.size()), cost, quality, false});
  return all;
}

TEST(ParetoFront, HasWhatNothingBeats) {
  // Dear and good, cheap and bad, beaten by the last, in between.
  EXPECT_EQ(pareto_front(points({{8.0, 40.0}, {1.0, 20.0}, {4.0, 29.0}, {3.0, 30.0}})),
            (Places{1, 3, 0}));
  // As cheap but worse, as good but dearer: beaten. The same twice: neither beats the other.
  EXPECT_EQ(pareto_front(points({{1.0, 5.0}, {1.0, 4.0}, {2.0, 5.0}, {1.0, 5.0}})), (Places{0, 3}));
  EXPECT_EQ(pareto_front({}), Places{});
}

TEST(PlotAxis, TicksAreRoundAndWithinTheRange) {
  EXPECT_EQ(logarithmic_ticks({0.5, 1.5}), (std::vector<double>{5.0, 10.0, 20.0}));  // 3.2 to 32
  EXPECT_EQ(linear_ticks({29.6, 33.2}),
            (std::vector<double>{30.0, 30.5, 31.0, 31.5, 32.0, 32.5, 33.0}));
  EXPECT_EQ(linear_ticks({0.0, 8.0}),
            (std::vector<double>{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}));
}

TEST(PlotAxis, OfOneValueHasAWidth) {
  const Axis axis = axis_of({3.0}, 1.0);
  EXPECT_DOUBLE_EQ(axis.min, 2.5);
  EXPECT_DOUBLE_EQ(axis.max, 3.5);
  EXPECT_DOUBLE_EQ(axis.fraction(3.0), 0.5);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(ScatterPlot, DrawsEachPointAndItsName) {
  Plot plot;
  plot.title = "a < b & c";
  plot.panels.push_back(
      {"panel", "dB", points({{8.0, 40.0}, {1.0, 20.0}, {4.0, 29.0}, {3.0, 30.0}})});
  plot.panels[0].points[0].marked = true;
  plot.lines.push_back({"bound", 0.5});
  const std::string svg = plot_as_svg(plot);
  EXPECT_EQ(count(svg, "class=\"best\""), 3U);
  EXPECT_EQ(count(svg, "class=\"point\""), 1U);
  EXPECT_EQ(count(svg, "class=\"ring\""), 1U);
  EXPECT_EQ(count(svg, "class=\"front\""), 1U);
  for (const char* name : {">p0<", ">p1<", ">p2<", ">p3<", ">bound<"})
    EXPECT_EQ(count(svg, name), 1U);
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(svg, plot_as_svg(plot));
}

TEST(ScatterPlot, OfNothingIsAnEmptyPlot) {
  Plot plot;
  plot.panels.push_back({"panel", "dB", {}});
  const std::string svg = plot_as_svg(plot);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace relief::cli
