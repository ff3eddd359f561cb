#include "preprocess/mls.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

// The weight's scale in local scan spacings: small enough to keep the scan's detail, large enough
// for at least six points with weight. Dragon: docs/decisions.md.
constexpr double kScaleInSpacings = 1.0;
// The least scale in grid spacings: a finer scan is averaged so that the grid does not alias.
constexpr double kScaleInGridSpacings = 0.5;
// Points beyond this many scales have weights below exp(-6.25) = 0.002 and are left out.
constexpr double kCutoff = 2.5;
// Ridge on the second-order terms, relative to the sum of weights (coordinates scaled by s).
constexpr double kRidge = 2e-3;
// The fit may leave the points' own tangent planes by this many scales; further is an overshoot.
constexpr double kMaxOvershoot = 0.5;

// Points whose normals differ from the nearest one's by more (60 degrees) lie beyond a crest: seen
// from the base plane they are near, on the surface they are not.
constexpr float kLeastLikeness = 0.5F;
// Fitted normals may leave the mean normal by up to 37 degrees; further is an overshoot.
constexpr float kLeastAgreement = 0.8F;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Right = Eigen::Matrix<double, 6, 4>;

struct Sums {
  Matrix6 normal_matrix = Matrix6::Zero();
  Right right_side = Right::Zero();  // heights, then the three components of the points' normals
  double weight = 0.0;
  double tangent = 0.0;  // weighted heights of tangent planes: the cheap implicit surface
  glm::vec3 normal{0.0F};
};

Sums accumulate(const PatchPoints& points, const PointGrid& lookup, glm::dvec3 about, double scale,
                glm::vec3 normal) {
  Sums sums;
  lookup.for_each_within(
      about.x, about.y, kCutoff * scale, [&](std::uint32_t p, double plane_squared) {
        const double dz = points.positions[p].z - about.z;
        const double squared = (plane_squared + dz * dz) / (scale * scale);
        if (squared > kCutoff * kCutoff) return;
        if (glm::dot(normal, points.normals[p]) < kLeastLikeness) return;
        const double w = std::exp(-squared);
        const double dx = (points.positions[p].x - about.x) / scale;
        const double dy = (points.positions[p].y - about.y) / scale;
        Vector6 basis;
        basis << 1.0, dx, dy, dx * dx, dx * dy, dy * dy;
        const Vector6 weighted = w * basis;
        const glm::vec3 n = points.normals[p];
        // All of the matrix, of which one half is read: shorter than to leave the other out.
        sums.normal_matrix.noalias() += basis * weighted.transpose();
        sums.right_side.noalias() += weighted * Eigen::RowVector4d(dz / scale, n.x, n.y, n.z);
        sums.weight += w;
        sums.tangent += w * (tangent_height(points, p, about.x, about.y) - about.z);
        sums.normal += static_cast<float>(w) * points.normals[p];
      });
  return sums;
}

glm::vec3 unit_or_up(glm::vec3 n) {
  const float length = glm::length(n);
  return length > 1e-6F ? n / length : glm::vec3(0.0F, 0.0F, 1.0F);
}

}  // namespace

SurfacePoint evaluate_mls(const PatchPoints& points, const PointGrid& supporting,
                          const PointGrid& all, double x, double y, double spacing) {
  const std::uint32_t nearest = supporting.nearest(x, y, 16.0 * spacing);
  if (nearest == PointGrid::kNone) return {0.0, {0, 0, 1}, {0, 0, 1}};
  const glm::dvec3 about(x, y, tangent_height(points, nearest, x, y));
  const double to_nearest = glm::distance(about, points.positions[nearest]);
  const double scale = std::max({kScaleInSpacings * points.spacing[nearest],
                                 kScaleInGridSpacings * spacing, 0.6 * to_nearest});

  Sums sums = accumulate(points, all, about, scale, points.normals[nearest]);
  if (!(sums.weight > 0.0)) return {about.z, points.normals[nearest], points.normals[nearest]};
  for (int d = 3; d < 6; ++d) sums.normal_matrix(d, d) += kRidge * sums.weight;
  for (int d = 1; d < 3; ++d) sums.normal_matrix(d, d) += 1e-6 * sums.weight;
  const Right fit =
      sums.normal_matrix.selfadjointView<Eigen::Lower>().ldlt().solve(sums.right_side);

  SurfacePoint out;
  const double implicit = sums.tangent / sums.weight;
  const glm::vec3 mean = unit_or_up(sums.normal);
  const bool sound =
      fit.allFinite() && std::abs(fit(0, 0) * scale - implicit) <= kMaxOvershoot * scale;
  out.height = about.z + (sound ? fit(0, 0) * scale : implicit);
  out.fitted_normal = sound ? unit_or_up(glm::vec3(-fit(1, 0), -fit(2, 0), 1.0)) : mean;
  // A mean alone leans towards where the points are; the fitted value does not.
  const glm::vec3 fitted_mean = unit_or_up(glm::vec3(fit(0, 1), fit(0, 2), fit(0, 3)));
  out.given_normal = sound && glm::dot(fitted_mean, mean) > kLeastAgreement ? fitted_mean : mean;
  return out;
}

}  // namespace relief
