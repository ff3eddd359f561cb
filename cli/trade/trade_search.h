// Which settings `relief bench --trade` measures next.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "cli/trade/trade_knobs.h"
#include "cli/trade/trade_row.h"

namespace relief::cli {

/// Up to `most` settings a step away from rows of the fronts that are not in `tried`, by turns: one
/// for the first row of each front, then one for the second ... Empty once every neighbour of the
/// fronts has been tried (Pareto local search). The same rows give the same settings.
[[nodiscard]] std::vector<TradeSetting> next_settings(const std::vector<TradeKnob>& knobs,
                                                      const std::vector<TradeRow>& rows,
                                                      const std::set<TradeSetting>& tried,
                                                      std::size_t most);

/// The rows whose time decides: the default, the presets, and those within `distance` of the front
/// of picture and frame time (distance_to_front), which a second measurement may put there.
[[nodiscard]] std::vector<std::size_t> rows_near_front(const std::vector<TradeRow>& rows,
                                                       double distance);

}  // namespace relief::cli
