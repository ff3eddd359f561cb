// `relief bench --trade` on the command line.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/trade/trade_answers.h"
#include "loader/scene/scene_plan.h"

namespace relief::cli {

struct TradeArguments {
  bool is_wanted = false;
  double seconds = 300.0;
  std::filesystem::path truth;
  std::filesystem::path page = "trade.html";
  std::vector<TradeQuestion> questions;  ///< empty: usual_questions()
};

/// Declares --trade, --trade-seconds, --truth, --ask and --report of `relief bench`, which fill
/// `arguments`. It must outlive `sub`, which has --plot, --engines and --sweep.
void add_trade_options(CLI::App& sub, TradeArguments& arguments);

/// Measures the trade of the plan's only model, writes the page and prints the report. Returns the
/// exit code.
int run_trade(const ScenePlan& plan, const RenderArguments& image, const TradeArguments& arguments,
              const std::vector<std::filesystem::path>& inputs);

}  // namespace relief::cli
