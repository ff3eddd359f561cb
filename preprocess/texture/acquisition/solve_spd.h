// Solves sparse symmetric positive definite systems.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "common/progress.h"

namespace relief {

struct SpdSolution {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  ///< |b - A x| / |b|; 0 where b is 0
  /// Ratio of the largest to the smallest eigenvalue of the matrix scaled to a unit diagonal, as
  /// estimated by the iteration: a lower bound, close once the residual is small. Absent without a
  /// step.
  std::optional<double> condition;
};

/// Solves A x = b by conjugate gradients with Jacobi's preconditioner from `start`, until the
/// residual is at most `tolerance` or after `max_iterations`. Rows of zeros leave their unknown
/// unchanged. The eigenvalues are those of Lanczos's tridiagonal matrix, made of the iteration's
/// coefficients (Golub and Van Loan, "Matrix Computations", 10.2). One thread. Returns an
/// intermediate result if `progress` is cancelled.
[[nodiscard]] SpdSolution solve_spd(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix,
                                    const Eigen::VectorXd& right_side, const Eigen::VectorXd& start,
                                    double tolerance, int max_iterations, const Progress& progress);

}  // namespace relief
