// How a file writes a number.
#pragma once

#include <cmath>
#include <limits>

#include "preprocess/readers/number_type.h"

namespace relief {

struct NumberForm {
  NumberType type = NumberType::Uint8;
  bool is_big_endian = false;

  bool operator==(const NumberForm&) const = default;
};

/// A number of a file as a value of a volume: NaN, which is no value, if a float cannot hold it.
template <class Number>
[[nodiscard]] float value_or_nan(Number number) {
  // Also false for NaN.
  const bool has_value = std::abs(number) <= Number{std::numeric_limits<float>::max()};
  return has_value ? static_cast<float>(number) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace relief
