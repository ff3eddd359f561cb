// The report of `relief compare`: the measured quantities by name, as JSON and as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/compare/compare.h"

namespace relief::cli {

/// One quantity of a comparison, with its key in JSON.
struct Quantity {
  const char* key;
  bool is_count;  ///< a whole number
  /// Its value, +infinity for the PSNR of equal images; or the reason why it was not measured, as a
  /// clause.
  Result<double> (*measure)(const Comparison& comparison);
};

/// All quantities, in the order of the JSON object.
[[nodiscard]] const std::vector<Quantity>& quantities();

/// Returns all quantities, null where there is no finite value, and the options of the comparison.
[[nodiscard]] nlohmann::ordered_json as_json(const Comparison& comparison,
                                             const FlipOptions& options);

/// Returns all quantities as text, without a title line.
[[nodiscard]] std::string as_text(const Comparison& comparison, const FlipOptions& options);

}  // namespace relief::cli
