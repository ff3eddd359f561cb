// The axes of plots.
#pragma once

#include <vector>

namespace relief::cli {

/// The range of an axis, in what is drawn: of a logarithmic one the decimal logarithms.
struct Axis {
  double least = 0.0;
  double most = 1.0;

  /// 0 to 1 within the range.
  [[nodiscard]] double place(double value) const { return (value - least) / (most - least); }
};

/// The range of some values, a little wider; never narrower than `least_width`.
[[nodiscard]] Axis axis_of(const std::vector<double>& values, double least_width);

/// 1, 2 and 5 times powers of ten within a logarithmic axis.
[[nodiscard]] std::vector<double> logarithmic_ticks(const Axis& axis);

/// Multiples of 1, 2 or 5 times a power of ten within an axis, about 8.
[[nodiscard]] std::vector<double> linear_ticks(const Axis& axis);

}  // namespace relief::cli
