#include "preprocess/resample/heights/fit_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace relief {
namespace {

/// Equations of a fit through `points` random points.
struct Fit {
  FitMatrix matrix{};
  FitColumn right{};
};

Fit random_fit(std::mt19937& random, int points) {
  std::normal_distribution<double> normal;
  Fit fit;
  for (int p = 0; p < points; ++p) {
    const double x = normal(random);
    const double y = normal(random);
    const double height = normal(random);
    const FitColumn basis{1.0, x, y, x * x, x * y, y * y};
    for (std::size_t c = 0; c < 6; ++c) {
      for (std::size_t r = 0; r < 6; ++r) fit.matrix[c][r] += basis[c] * basis[r];
      fit.right[c] += basis[c] * height;
    }
  }
  return fit;
}

TEST(FitEquations, SolvesAsEigenDoes) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Fit fit = random_fit(random, 12 + trial % 20);
    const FitColumn solution = FitEquations(fit.matrix).solve(fit.right);
    const Eigen::Map<const Eigen::Matrix<double, 6, 6>> matrix(fit.matrix.front().data());
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> right(fit.right.data());
    const Eigen::Matrix<double, 6, 1> expected = matrix.ldlt().solve(right);
    for (int k = 0; k < 6; ++k) {
      // Rounding of doubles times the condition of some hundred.
      EXPECT_NEAR(solution[static_cast<std::size_t>(k)], expected[k],
                  1e-11 * (1.0 + expected.norm()));
    }
  }
}

TEST(FitEquations, TellAboutTheirCondition) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    const Fit fit = random_fit(random, 6 + trial % 20);
    const Eigen::Map<const Eigen::Matrix<double, 6, 6>> matrix(fit.matrix.front().data());
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
    const double expected = values[5] / values[0];
    const double condition = FitEquations(fit.matrix).condition();
    // Pivots lie between the eigenvalues. Of 1,000 fits the worst is off by a factor of 48.
    EXPECT_LE(condition, 1.001 * expected);
    EXPECT_GE(condition, expected / 60.0);
  }
}

TEST(FitEquations, ReadsTheLowerHalf) {
  std::mt19937 random(2);
  Fit fit = random_fit(random, 20);
  const FitColumn solution = FitEquations(fit.matrix).solve(fit.right);
  for (std::size_t c = 1; c < 6; ++c) {
    for (std::size_t r = 0; r < c; ++r) fit.matrix[c][r] = std::nan("");
  }
  EXPECT_EQ(FitEquations(fit.matrix).solve(fit.right), solution);
}

TEST(FitEquations, LeavesUnknownsWithoutEquationAtZero) {
  FitMatrix matrix{};
  matrix[3][3] = 4.0;
  EXPECT_EQ(FitEquations(matrix).solve({1.0, 2.0, 3.0, 8.0, 5.0, 6.0}),
            (FitColumn{0.0, 0.0, 0.0, 2.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace relief
