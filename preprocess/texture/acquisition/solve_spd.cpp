#include "preprocess/texture/acquisition/solve_spd.h"

#include <Eigen/Eigenvalues>
#include <cassert>
#include <cmath>
#include <vector>

namespace relief {
namespace {

/// The steps and directions of conjugate gradients as Lanczos's tridiagonal matrix.
std::optional<double> condition_of(const std::vector<double>& alphas,
                                   const std::vector<double>& betas) {
  const auto n = static_cast<Eigen::Index>(alphas.size());
  if (n == 0) return std::nullopt;
  Eigen::VectorXd diagonal(n);
  Eigen::VectorXd beside(n - 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    diagonal[i] = 1.0 / alphas[k];
    if (i > 0) diagonal[i] += betas[k - 1] / alphas[k - 1];
    if (i + 1 < n) beside[i] = std::sqrt(betas[k]) / alphas[k];
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside, Eigen::EigenvaluesOnly);
  const double smallest = solver.eigenvalues().minCoeff();
  if (!(smallest > 0.0)) return std::nullopt;
  return solver.eigenvalues().maxCoeff() / smallest;
}

}  // namespace

SpdSolution solve_spd(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix,
                      const Eigen::VectorXd& right_side, const Eigen::VectorXd& start,
                      double tolerance, int max_iterations, const Progress& progress) {
  assert(matrix.rows() == matrix.cols() && matrix.rows() == right_side.size() &&
         right_side.size() == start.size());
  SpdSolution solution;
  solution.x = start;
  const double scale = right_side.norm();
  if (!(scale > 0.0)) {
    solution.x.setZero();
    return solution;
  }
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const Eigen::VectorXd inverse = (diagonal.array() > 0.0).select(1.0 / diagonal.array(), 0.0);
  Eigen::VectorXd residual = right_side - matrix * start;
  Eigen::VectorXd scaled = inverse.cwiseProduct(residual);
  Eigen::VectorXd direction = scaled;
  double rho = residual.dot(scaled);
  std::vector<double> alphas;
  std::vector<double> betas;
  while (residual.norm() > tolerance * scale && solution.iterations < max_iterations &&
         !progress.cancelled()) {
    const Eigen::VectorXd image = matrix * direction;
    const double curvature = direction.dot(image);
    // A direction without curvature: the matrix is singular to rounding.
    if (!(curvature > 0.0)) break;
    const double alpha = rho / curvature;
    solution.x += alpha * direction;
    residual -= alpha * image;
    scaled = inverse.cwiseProduct(residual);
    const double next = residual.dot(scaled);
    alphas.push_back(alpha);
    betas.push_back(next / rho);
    direction = scaled + (next / rho) * direction;
    rho = next;
    ++solution.iterations;
  }
  // Computed again, because the updated residual drifts away from the true one.
  solution.residual = (right_side - matrix * solution.x).norm() / scale;
  solution.condition = condition_of(alphas, betas);
  return solution;
}

}  // namespace relief
