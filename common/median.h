// The median.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace relief {

/// Returns the median of values, the upper one of two. There is at least one, and none is NaN.
template <class Value>
[[nodiscard]] Value median_of(std::vector<Value> values) {
  assert(!values.empty() && "a median is of something");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace relief
