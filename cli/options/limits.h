// --fail-below and --fail-above: what turns a comparison into a regression test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/compare/compare.h"
#include "common/error.h"

namespace relief::cli {

enum class Bound : std::uint8_t { Below, Above };

/// A quantity must not be below, or above, a value.
struct Limit {
  std::string key;
  Bound fail = Bound::Below;
  double value = 0.0;
};

/// Parses "KEY=VALUE". Throws CLI::ValidationError if the quantity is unknown or the value is not a
/// finite number.
[[nodiscard]] Limit parse_limit(const std::string& text, Bound fail);

/// Returns clauses about all limits that do not hold; nothing if all hold. A quantity that was not
/// measured fails its limits. The PSNR of equal images is infinite and passes every lower bound.
[[nodiscard]] std::optional<Error> find_broken_limits(const std::vector<Limit>& limits,
                                                      const Comparison& comparison);

}  // namespace relief::cli
