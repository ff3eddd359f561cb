// The report of `relief bench --trade` as JSON and as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/trade/trade.h"

namespace relief::cli {

/// Keys: docs/trade.md.
[[nodiscard]] nlohmann::ordered_json as_json(const TradeReport& report);

/// The answers, the presets and the front of picture and frame time. `page`: the file that has the
/// rest.
[[nodiscard]] std::string as_text(const TradeReport& report, const std::string& page);

/// "the scan's own 871,306 faces" and so on.
[[nodiscard]] std::string describe_truth(const TradeReport& report);

/// What the row costs and how good it is, in a line.
[[nodiscard]] std::string describe_row(const TradeRow& row);

}  // namespace relief::cli
