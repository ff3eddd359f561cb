// The plots of `relief bench --trade`, as SVG within a page.
#pragma once

#include <string>
#include <vector>

#include "cli/trade/trade_front.h"
#include "cli/trade/trade_knobs.h"
#include "cli/trade/trade_row.h"

namespace relief::cli {

/// What draws a row, by which points are coloured: "onepass cell".
[[nodiscard]] std::string painter_of(const std::vector<TradeKnob>& knobs, const TradeRow& row);

/// The painters of some rows, in the order of the knobs' choices, each once.
[[nodiscard]] std::vector<std::string> painters_of(const std::vector<TradeKnob>& knobs,
                                                   const std::vector<TradeRow>& rows);

/// The colour of the n-th painter, as in CSS.
[[nodiscard]] std::string colour_of_painter(std::size_t n);

/// A plot of all rows that have both values: a logarithmic axis of cost, and quality upward, so
/// that better is always to the upper left. The front is joined; presets have rings and their
/// names. Points have the number of their row as `data-row`, and a title. The classes are those of
/// trade_plot_style().
[[nodiscard]] std::string trade_plot(const std::vector<TradeKnob>& knobs,
                                     const std::vector<TradeRow>& rows, const TradePlane& plane);

/// Rules of CSS for the plots.
[[nodiscard]] const char* trade_plot_style();

/// A value as a person reads it: "479,120", "36.4 MB", "48.1 dB".
[[nodiscard]] std::string readable(const TradeQuantity& quantity, double value);

}  // namespace relief::cli
