// Height fields of second order, fitted to the points around one over growing discs.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "preprocess/noise/rings.h"

namespace relief {

/// A height field of second order about a point, in units of the spacing there.
struct Quadric {
  glm::dmat3 axes;  ///< columns: two in the plane, and the plane's normal; right-handed
  Eigen::Matrix<double, 6, 1> terms;  ///< of 1, u, v, u u, u v, v v
  double leverage = 0.0;  ///< variance of the height at the centre over that of a point's noise
  double rms = 0.0;       ///< of the points' heights above it, for its degrees of freedom
};

/// The distance of a point to a quadric along its normal there, to first order.
struct QuadricDistance {
  double distance = 0.0;  ///< units; positive on the side of the normal
  double squared = 0.0;   ///< distance of the foot point to the centre in the plane, units
  glm::dvec3 normal;      ///< unit
};

[[nodiscard]] QuadricDistance distance_to(const Quadric& quadric, const glm::dvec3& offset);

/// Fits a quadric to discs of one centre, each larger than the one before, by least squares. The
/// plane is that of the principal component analysis of the disc.
class QuadricFit {
 public:
  /// The smallest number of points that a fit of six terms takes.
  static constexpr std::size_t kFewestPoints = 10;

  /// Forgets the points of the last centre.
  void start();
  /// Adds a ring's points.
  void add(std::span<const Rings::Neighbour> ring);
  /// Fits all `points` added so far. Returns nothing for fewer than kFewestPoints, or if they lie
  /// on a line.
  [[nodiscard]] std::optional<Quadric> fit(std::span<const Rings::Neighbour> points);

 private:
  void sum_up(std::span<const Rings::Neighbour> points);
  [[nodiscard]] bool turn_plane();

  double count_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
  glm::dmat3 axes_{0.0};
  std::size_t summed_ = 0;  // of the points, about axes_
  Eigen::Matrix<double, 6, 6> normal_matrix_ = Eigen::Matrix<double, 6, 6>::Zero();  // lower half
  Eigen::Matrix<double, 6, 1> right_side_ = Eigen::Matrix<double, 6, 1>::Zero();
  double squared_heights_ = 0.0;
};

}  // namespace relief
