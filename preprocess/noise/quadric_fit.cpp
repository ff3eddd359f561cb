#include "preprocess/noise/quadric_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "preprocess/points/complete_frame.h"

namespace relief {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// A plane that has turned by less (8 degrees) keeps its sums: a quadric describes a tilted one too.
constexpr double kSamePlane = 0.99;
// Second variance over the first below which points lie on a line.
constexpr double kLine = 1e-6;
// Ridge relative to the number of points: it decides only where they don't.
constexpr double kNoiseRidge = 1e-9;

Vector6 terms_at(double u, double v) {
  return (Vector6() << 1.0, u, v, u * u, u * v, v * v).finished();
}

}  // namespace

QuadricDistance distance_to(const Quadric& quadric, const glm::dvec3& offset) {
  const glm::dvec3 local = offset * quadric.axes;  // the transposed times the offset
  const double u = local.x;
  const double v = local.y;
  const Vector6& c = quadric.terms;
  const double above = local.z - c.dot(terms_at(u, v));
  const double along_u = c[1] + 2.0 * c[3] * u + c[4] * v;
  const double along_v = c[2] + c[4] * u + 2.0 * c[5] * v;
  const double length = std::sqrt(1.0 + along_u * along_u + along_v * along_v);
  return {above / length, u * u + v * v,
          quadric.axes * (glm::dvec3(-along_u, -along_v, 1.0) / length)};
}

void QuadricFit::start() {
  count_ = 0.0;
  sum_.setZero();
  squares_.setZero();
  axes_ = glm::dmat3(0.0);
}

void QuadricFit::add(std::span<const Rings::Neighbour> ring) {
  for (const Rings::Neighbour& n : ring) {
    const Eigen::Vector3d v(n.offset.x, n.offset.y, n.offset.z);
    sum_ += v;
    squares_.noalias() += v * v.transpose();
  }
  count_ += static_cast<double>(ring.size());
}

bool QuadricFit::turn_plane() {
  const Eigen::Vector3d mean = sum_ / count_;
  const Eigen::Matrix3d covariance = squares_ / count_ - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  if (!(solver.eigenvalues()[1] > kLine * solver.eigenvalues()[2])) return false;
  const Eigen::Vector3d n = solver.eigenvectors().col(0);
  glm::dvec3 normal(n.x(), n.y(), n.z());
  const double cosine = glm::dot(normal, axes_[2]);
  if (std::abs(cosine) >= kSamePlane) return true;
  if (cosine < 0.0) normal = -normal;
  axes_[2] = normal;
  complete_frame(normal, axes_[0], axes_[1]);
  summed_ = 0;
  normal_matrix_.setZero();
  right_side_.setZero();
  squared_heights_ = 0.0;
  return true;
}

void QuadricFit::sum_up(std::span<const Rings::Neighbour> points) {
  for (const Rings::Neighbour& n : points.subspan(summed_)) {
    const glm::dvec3 local = n.offset * axes_;
    const Vector6 terms = terms_at(local.x, local.y);
    for (int c = 0; c < 6; ++c) {
      for (int r = c; r < 6; ++r) normal_matrix_(r, c) += terms[r] * terms[c];
    }
    right_side_ += local.z * terms;
    squared_heights_ += local.z * local.z;
  }
  summed_ = points.size();
}

std::optional<Quadric> QuadricFit::fit(std::span<const Rings::Neighbour> points) {
  if (points.size() < kFewestPoints || !turn_plane()) return std::nullopt;
  sum_up(points);
  Eigen::Matrix<double, 6, 6> matrix = normal_matrix_;
  matrix.diagonal().array() += kNoiseRidge * count_;
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>, Eigen::Lower> factors(matrix);
  Quadric quadric{axes_, factors.solve(right_side_)};
  quadric.leverage = factors.solve(Vector6::Unit(0))[0];
  const double left = squared_heights_ - quadric.terms.dot(right_side_);
  quadric.rms = std::sqrt(std::max(left, 0.0) / (count_ - 6.0));
  if (!quadric.terms.allFinite() || !(quadric.leverage > 0.0)) return std::nullopt;
  return quadric;
}

}  // namespace relief
