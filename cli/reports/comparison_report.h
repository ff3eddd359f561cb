// What `relief compare` reports: the measured quantities by name, as JSON and as text.
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
  /// Its value, +infinity for the PSNR of what does not differ; or why it was not measured, as a
  /// clause.
  Result<double> (*measure)(const Comparison& comparison);
};

/// All quantities, in the order of the JSON object.
[[nodiscard]] const std::vector<Quantity>& quantities();

/// All quantities, null where there is no finite value, and what was done.
[[nodiscard]] nlohmann::ordered_json as_json(const Comparison& comparison,
                                             const FlipOptions& options);

/// All quantities as text for a person, without a title line.
[[nodiscard]] std::string as_text(const Comparison& comparison, const FlipOptions& options);

}  // namespace relief::cli
