#include "preprocess/texture/acquisition/solve_spd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relief::test {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The second difference of n unknowns between fixed ends; scaled to a unit diagonal its
/// eigenvalues are 1 - cos(k pi / (n + 1)).
Matrix second_difference(Eigen::Index n) {
  Matrix matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) matrix.insert(i, i - 1) = -1.0;
    matrix.insert(i, i) = 2.0;
    if (i + 1 < n) matrix.insert(i, i + 1) = -1.0;
  }
  return matrix;
}

TEST(SolveSpd, SolvesAndKnowsTheCondition) {
  constexpr Eigen::Index kSize = 60;
  const Matrix matrix = second_difference(kSize);
  Eigen::VectorXd truth(kSize);
  for (Eigen::Index i = 0; i < kSize; ++i) truth[i] = std::sin(static_cast<double>(i * i));
  const SpdSolution solution =
      solve_spd(matrix, matrix * truth, Eigen::VectorXd::Zero(kSize), 1e-12, 1000, Progress());
  EXPECT_LE(solution.residual, 1e-12);
  // The residual times the condition, 1509.
  EXPECT_LT((solution.x - truth).norm() / truth.norm(), 2e-9);
  const double angle = std::numbers::pi / (kSize + 1);
  const double condition = (1.0 + std::cos(angle)) / (1.0 - std::cos(angle));
  ASSERT_TRUE(solution.condition);
  EXPECT_NEAR(*solution.condition / condition, 1.0, 1e-6) << "converged: Ritz values are exact";
}

TEST(SolveSpd, ReportsTheResidualThatItHasWhenItMustStop) {
  const Matrix matrix = second_difference(60);
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(60);
  const SpdSolution solution =
      solve_spd(matrix, b, Eigen::VectorXd::Zero(60), 1e-12, 5, Progress());
  EXPECT_EQ(solution.iterations, 5);
  EXPECT_GT(solution.residual, 1e-3);
  EXPECT_DOUBLE_EQ(solution.residual, (b - matrix * solution.x).norm() / b.norm());
}

TEST(SolveSpd, StartingAtTheSolutionTakesNoStep) {
  const Matrix matrix = second_difference(10);
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(10);
  const SpdSolution solution = solve_spd(matrix, matrix * x, x, 1e-12, 100, Progress());
  EXPECT_EQ(solution.iterations, 0);
  EXPECT_EQ(solution.x, x);
  EXPECT_FALSE(solution.condition) << "not measured is not 0 and not 1";
}

TEST(SolveSpd, RowsOfZerosLeaveTheirUnknown) {
  Matrix matrix(3, 3);
  matrix.insert(0, 0) = 4.0;
  matrix.insert(2, 2) = 5.0;
  const SpdSolution solution = solve_spd(matrix, Eigen::Vector3d(8, 0, 10),
                                         Eigen::Vector3d(0, 7, 0), 1e-12, 100, Progress());
  EXPECT_NEAR((solution.x - Eigen::Vector3d(2, 7, 2)).norm(), 0.0, 1e-12);
}

TEST(SolveSpd, ARightSideOfZerosGivesZeros) {
  const Matrix matrix = second_difference(4);
  const SpdSolution solution =
      solve_spd(matrix, Eigen::VectorXd::Zero(4), Eigen::VectorXd::Ones(4), 1e-12, 100, Progress());
  EXPECT_EQ(solution.x, Eigen::VectorXd::Zero(4));
}

}  // namespace
}  // namespace relief::test
