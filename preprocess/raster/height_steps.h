// The step that a raster's heights are whole multiples of.
#pragma once

#include <span>

namespace relief {

/// Finds the range and the step of floating-point heights. Many files hold decimal numbers: metres
/// with two decimals are whole centimetres.
class HeightSteps {
 public:
  /// Notes heights; NaN are no heights.
  void add(std::span<const double> heights);

  [[nodiscard]] bool empty() const { return !(low_ <= high_); }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }
  /// Returns the largest of 1, 0.1, 0.01 ... 0.00001 that all heights are multiples of, within the
  /// precision of single-precision numbers; 0 if there is none.
  [[nodiscard]] double decimal_step() const;

 private:
  static constexpr int kDecimals = 6;
  double low_ = 1e300;
  double high_ = -1e300;
  int decimals_ = 0;  ///< the fewest that describe all heights so far; kDecimals: too few
};

}  // namespace relief
