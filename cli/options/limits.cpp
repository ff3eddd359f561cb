#include "cli/options/limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "cli/options/values.h"
#include "cli/reports/comparison_report.h"

namespace relief::cli {
namespace {

const Quantity* find_quantity(std::string_view key) {
  const auto& all = quantities();
  const auto found =
      std::find_if(all.begin(), all.end(), [key](const Quantity& q) { return q.key == key; });
  return found != all.end() ? &*found : nullptr;
}

std::string names_of_all() {
  std::vector<std::string_view> names;
  for (const Quantity& quantity : quantities()) names.emplace_back(quantity.key);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// A clause about a limit that does not hold; empty if it does.
std::string find_fault(const Limit& limit, const Comparison& comparison) {
  const auto value = find_quantity(limit.key)->measure(comparison);
  if (!value) return fmt::format("{} was not measured ({})", limit.key, value.error().message);
  const bool below = limit.fail == Bound::Below;
  if (below ? *value >= limit.value : *value <= limit.value) return {};
  return fmt::format("{} is {}, {} {}", limit.key,
                     std::isfinite(*value) ? fmt::format("{:.9g}", *value) : "infinite",
                     below ? "below" : "above", limit.value);
}

}  // namespace

Limit parse_limit(const std::string& text, Bound fail) {
  const char* const option = fail == Bound::Below ? "--fail-below" : "--fail-above";
  const std::size_t equals = std::min(text.find('='), text.size());
  Limit limit{text.substr(0, equals), fail, 0.0};
  if (find_quantity(limit.key) == nullptr) {
    throw CLI::ValidationError(option, fmt::format("there is no '{}' to compare; there are {}",
                                                   limit.key, names_of_all()));
  }
  const auto value = parse_number(std::string_view(text).substr(std::min(equals + 1, text.size())));
  if (!value) {
    throw CLI::ValidationError(option, "expected KEY=NUMBER, as in psnr_db=40; found " + text);
  }
  limit.value = *value;
  return limit;
}

std::optional<Error> find_broken_limits(const std::vector<Limit>& limits,
                                        const Comparison& comparison) {
  std::vector<std::string> faults;
  for (const Limit& limit : limits) {
    std::string fault = find_fault(limit, comparison);
    if (!fault.empty()) faults.push_back(std::move(fault));
  }
  if (faults.empty()) return std::nullopt;
  return make_error("{}", fmt::join(faults, "; "));
}

}  // namespace relief::cli
