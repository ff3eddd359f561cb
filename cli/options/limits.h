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

/// "KEY=VALUE". Throws CLI::ValidationError if there is no such quantity or the value is no finite
/// number.
[[nodiscard]] Limit parse_limit(const std::string& text, Bound fail);

/// Clauses about all limits that do not hold, or nothing. A quantity that was not measured holds no
/// limit; the PSNR of what does not differ is infinite and so above any.
[[nodiscard]] std::optional<Error> find_broken_limits(const std::vector<Limit>& limits,
                                                      const Comparison& comparison);

}  // namespace relief::cli
