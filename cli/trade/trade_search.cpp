#include "cli/trade/trade_search.h"

#include <algorithm>
#include <utility>

#include "cli/trade/trade_front.h"

namespace relief::cli {
namespace {

/// Rows on the fronts, by turns between the fronts, each once.
std::vector<std::size_t> rows_on_fronts(const std::vector<TradeRow>& rows) {
  std::vector<std::vector<std::size_t>> fronts;
  std::size_t longest = 0;
  for (const TradePlane& plane : trade_planes()) {
    fronts.push_back(front_of(rows, plane));
    longest = std::max(longest, fronts.back().size());
  }
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < longest; ++k) {
    for (const auto& front : fronts) {
      if (k < front.size() && std::find(found.begin(), found.end(), front[k]) == found.end())
        found.push_back(front[k]);
    }
  }
  return found;
}

}  // namespace

std::vector<TradeSetting> next_settings(const std::vector<TradeKnob>& knobs,
                                        const std::vector<TradeRow>& rows,
                                        const std::set<TradeSetting>& tried, std::size_t most) {
  std::set<TradeSetting> seen = tried;
  std::vector<std::vector<TradeSetting>> near;
  for (const std::size_t row : rows_on_fronts(rows)) {
    std::vector<TradeSetting> steps;
    for (TradeSetting& step : steps_from(knobs, rows[row].setting)) {
      if (seen.insert(step).second) steps.push_back(std::move(step));
    }
    near.push_back(std::move(steps));
  }
  std::vector<TradeSetting> next;
  bool has_more = true;
  for (std::size_t k = 0; has_more && next.size() < most; ++k) {
    has_more = false;
    for (auto& steps : near) {
      if (k >= steps.size() || next.size() >= most) continue;
      next.push_back(std::move(steps[k]));
      has_more = true;
    }
  }
  return next;
}

std::vector<std::size_t> rows_near_front(const std::vector<TradeRow>& rows, double distance) {
  const TradePlane& plane = trade_planes().front();
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto behind = distance_to_front(rows, k, plane);
    if (rows[k].quality || (behind && *behind <= distance)) found.push_back(k);
  }
  return found;
}

}  // namespace relief::cli
