// The report of `relief bench --trade` as a page of HTML.
#pragma once

#include <string>

#include "cli/trade/trade.h"

namespace relief::cli {

/// A page that needs no other file and no network: plots whose points tell their values, answers,
/// presets, a table of all settings, and the JSON of the report in the element `report`.
[[nodiscard]] std::string trade_page(const TradeReport& report);

/// The page's script: shows a point's row while the mouse is over it, marks it in all plots, and
/// sorts the table.
[[nodiscard]] const char* trade_page_script();

/// The page's rules of CSS, without those of the plots.
[[nodiscard]] const char* trade_page_style();

}  // namespace relief::cli
