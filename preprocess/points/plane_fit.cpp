#include "preprocess/points/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace relief {

PlaneFit fit_plane(const std::vector<glm::dvec3>& positions, std::size_t one,
                   std::span<const std::uint32_t> others) {
  const glm::dvec3 base = positions[one];
  glm::dvec3 sum(0.0);
  for (const std::uint32_t j : others) sum += positions[j] - base;
  const double count = static_cast<double>(others.size()) + 1.0;
  const glm::dvec3 mean = sum / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const auto add = [&](glm::dvec3 d) {
    const Eigen::Vector3d v(d.x, d.y, d.z);
    covariance.noalias() += v * v.transpose();
  };
  add(-mean);
  for (const std::uint32_t j : others) add(positions[j] - base - mean);
  covariance /= count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d& values = solver.eigenvalues();
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double least = std::max(values[0], 0.0);
  return {base + mean,
          {normal.x(), normal.y(), normal.z()},
          least / std::max(values.sum(), 1e-300),
          std::sqrt(least)};
}

}  // namespace relief
