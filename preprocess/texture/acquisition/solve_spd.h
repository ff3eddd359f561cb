// Sparse symmetric positive definite systems.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "common/progress.h"

namespace relief {

struct SpdSolution {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0.0;  ///< |b - A x| / |b|; 0 where b is 0
  /// Largest over smallest eigenvalue of the matrix scaled to a unit diagonal, as the iteration saw
  /// it: from below, and close once the residual is small. None if it took no step.
  std::optional<double> condition;
};

/// Conjugate gradients with Jacobi's preconditioner from `start` until the residual is at most
/// `tolerance` or after `most_iterations`; the residual tells which. Rows of zeros leave their
/// unknown as it starts. The eigenvalues are those of Lanczos's tridiagonal matrix, which the
/// iteration's own coefficients make (Golub and Van Loan, "Matrix Computations", 10.2). One thread.
/// Stops early, with what it has, when `progress` is cancelled.
[[nodiscard]] SpdSolution solve_spd(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix,
                                    const Eigen::VectorXd& right_side, const Eigen::VectorXd& start,
                                    double tolerance, int most_iterations,
                                    const Progress& progress);

}  // namespace relief
