// The equations of a fit of moving least squares.
#pragma once

#include <array>

namespace relief {

/// The unknowns of a quadratic polynomial in two coordinates.
inline constexpr int kFitUnknowns = 6;
using FitColumn = std::array<double, kFitUnknowns>;
/// A symmetric matrix by columns; what is above the diagonal is not read.
using FitMatrix = std::array<FitColumn, kFitUnknowns>;

/// Normal equations, factorised as L D L^T with pivots (Golub and Van Loan 1996, 4.2.9).
///
/// Rounds as Eigen's LDLT does on processors with two doubles in a register, on which the bytes of
/// patch files used to depend, but takes a third of its time: all sizes are known here.
class FitEquations {
 public:
  explicit FitEquations(const FitMatrix& matrix);

  /// Returns the unknowns for a right side. What a vanishing pivot leaves open is 0.
  [[nodiscard]] FitColumn solve(FitColumn right) const;

  /// Returns the largest pivot over the smallest: at most the matrix's condition number, and
  /// seldom less than a twentieth of it. Infinite if a pivot vanishes.
  [[nodiscard]] double condition() const;

 private:
  template <int k>
  void eliminate();
  void exchange(int k, int other);

  FitMatrix m_;                                ///< L below the diagonal, D on it
  std::array<int, kFitUnknowns> exchanged_{};  ///< with which each unknown changed places
};

}  // namespace relief
