// Values of a JSON report.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace relief::cli {

/// The value, or null if there is none.
template <class T>
[[nodiscard]] nlohmann::ordered_json value_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// The value, or null if there is none or JSON cannot write it (infinity).
[[nodiscard]] inline nlohmann::ordered_json finite_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value)
                                        : nlohmann::ordered_json(nullptr);
}

}  // namespace relief::cli
