#include "preprocess/resample/heights/fit_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace relief {

FitEquations::FitEquations(const FitMatrix& matrix) : m_(matrix) {
  // Steps whose length the compiler knows, without loops: half of the time.
  eliminate<0>();
  eliminate<1>();
  eliminate<2>();
  eliminate<3>();
  eliminate<4>();
  eliminate<5>();
}

template <int k>
void FitEquations::eliminate() {
  int largest = k;
  for (int d = k + 1; d < kFitUnknowns; ++d) {
    if (std::abs(m_[d][d]) > std::abs(m_[largest][largest])) largest = d;
  }
  exchanged_[k] = largest;
  if (largest != k) exchange(k, largest);
  if constexpr (k > 0) {
    FitColumn sums;
    const double first = m_[0][0] * m_[0][k];
    for (int r = k; r < kFitUnknowns; ++r) sums[r] = m_[0][r] * first;
    for (int c = 1; c < k; ++c) {
      const double scaled = m_[c][c] * m_[c][k];
      for (int r = k; r < kFitUnknowns; ++r) sums[r] += m_[c][r] * scaled;
    }
    for (int r = k; r < kFitUnknowns; ++r) m_[k][r] -= sums[r];
  }
  const double pivot = m_[k][k];
  if (!(std::abs(pivot) > 0.0)) return;
  for (int r = k + 1; r < kFitUnknowns; ++r) m_[k][r] /= pivot;
}

/// Of the columns before k, which are L's, rows; of the others, both rows and columns.
void FitEquations::exchange(int k, int other) {
  for (int c = 0; c < k; ++c) std::swap(m_[c][k], m_[c][other]);
  for (int r = other + 1; r < kFitUnknowns; ++r) std::swap(m_[k][r], m_[other][r]);
  std::swap(m_[k][k], m_[other][other]);
  for (int i = k + 1; i < other; ++i) std::swap(m_[k][i], m_[i][other]);
}

double FitEquations::condition() const {
  double largest = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kFitUnknowns; ++k) {
    largest = std::max(largest, std::abs(m_[k][k]));
    smallest = std::min(smallest, std::abs(m_[k][k]));
  }
  return largest / smallest;
}

FitColumn FitEquations::solve(FitColumn x) const {
  for (int k = 0; k < kFitUnknowns; ++k) std::swap(x[k], x[exchanged_[k]]);
  // Four unknowns one after another, then their sums: the order of Eigen's panels.
  x[1] -= x[0] * m_[0][1];
  x[2] -= x[0] * m_[0][2];
  x[3] -= x[0] * m_[0][3];
  x[2] -= x[1] * m_[1][2];
  x[3] -= x[1] * m_[1][3];
  x[3] -= x[2] * m_[2][3];
  for (int r = 4; r < kFitUnknowns; ++r)
    x[r] -= m_[0][r] * x[0] + m_[1][r] * x[1] + m_[2][r] * x[2] + m_[3][r] * x[3];
  x[5] -= x[4] * m_[4][5];
  for (int k = 0; k < kFitUnknowns; ++k)
    x[k] = std::abs(m_[k][k]) > std::numeric_limits<double>::min() ? x[k] / m_[k][k] : 0.0;
  x[4] -= m_[4][5] * x[5];
  x[3] -= m_[3][4] * x[4] + m_[3][5] * x[5];
  x[2] -= m_[2][3] * x[3] + m_[2][4] * x[4] + m_[2][5] * x[5];
  for (int k = 1; k >= 0; --k)
    x[k] -= m_[k][2] * x[2] + m_[k][3] * x[3] + m_[k][4] * x[4] + m_[k][5] * x[5];
  x[0] -= m_[0][1] * x[1];
  for (int k = kFitUnknowns - 1; k >= 0; --k) std::swap(x[k], x[exchanged_[k]]);
  return x;
}

}  // namespace relief
