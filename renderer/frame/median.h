// The middle of some measurements.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace relief {

/// The upper median; `values` must not be empty.
[[nodiscard]] inline double median(std::vector<double> values) {
  assert(!values.empty() && "a median is of something");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace relief
