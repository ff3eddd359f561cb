// The axes of plots.
#pragma once

#include <vector>

namespace relief::cli {

/// The range of an axis; a logarithmic axis has decimal logarithms.
struct Axis {
  double min = 0.0;
  double max = 1.0;

  /// Returns 0 to 1 within the range.
  [[nodiscard]] double fraction(double value) const { return (value - min) / (max - min); }
};

/// Returns the range of some values, 16 % wider, and never narrower than `min_width`.
[[nodiscard]] Axis axis_of(const std::vector<double>& values, double min_width);

/// Returns 1, 2 and 5 times powers of ten within a logarithmic axis.
[[nodiscard]] std::vector<double> logarithmic_ticks(const Axis& axis);

/// Returns multiples of 1, 2 or 5 times a power of ten within an axis, about 8.
[[nodiscard]] std::vector<double> linear_ticks(const Axis& axis);

}  // namespace relief::cli
