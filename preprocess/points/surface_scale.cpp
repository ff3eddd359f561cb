#include "preprocess/points/surface_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// Below this ratio of the variances along the second and the first principal direction, so many
/// points are a line. Points at random on a surface have 0.17, 0.35 and 0.48 with 8, 16 and 32
/// neighbours, 95 % of them more; the border of a scan has a quarter.
double line_ratio(std::uint32_t neighbours) {
  if (neighbours <= 8) return 0.02;
  return neighbours <= 16 ? 0.06 : 0.12;
}

// A plane whose points vary less along its normal, beside the second direction, is flat.
constexpr double kFlat = 0.01;
// The cosine of 60 degrees. Planes of a sharp edge turn by 45.
constexpr double kTurn = 0.5;
// A plane is compared with those of up to so many scales above: 8 times the neighbours.
constexpr std::size_t kScalesAbove = 3;

// How much farther the fourth neighbour of a grid is than the first. Of points at random 3 % are so
// near.
constexpr double kGridTolerance = 1.2;

/// What a number of nearest neighbours look like.
struct Shape {
  bool is_line = false;
  bool is_flat = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

Shape shape_of(const Eigen::Vector3d& sum, const Eigen::Matrix3d& squares,
               std::uint32_t neighbours) {
  const double count = neighbours + 1.0;  // the point itself, at the origin, is one
  const Eigen::Matrix3d covariance = squares / count - (sum / count) * (sum / count).transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  const Eigen::Vector3d& variances = solver.computeDirect(covariance).eigenvalues();
  return {variances[1] < line_ratio(neighbours) * variances[2], variances[0] < kFlat * variances[1],
          solver.eigenvectors().col(0)};
}

/// Whether a scale's plane is that of a line and its noise: flat, but another than that of more
/// neighbours.
bool turns(std::span<const Shape> shapes, std::size_t scale) {
  if (!shapes[scale].is_flat) return false;
  const std::size_t end = std::min(shapes.size(), scale + 1 + kScalesAbove);
  for (std::size_t above = scale + 1; above < end; ++above) {
    if (std::abs(shapes[scale].normal.dot(shapes[above].normal)) < kTurn) return true;
  }
  return false;
}

}  // namespace

std::uint32_t first_surface_scale(std::span<const glm::dvec3> offsets, Strips strips) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  std::array<Shape, kSurfaceScales.size()> shapes;
  std::size_t scales = 0;
  std::size_t added = 0;
  for (const std::uint32_t neighbours : kSurfaceScales) {
    if (neighbours > offsets.size()) break;
    for (; added < neighbours; ++added) {
      const Eigen::Vector3d offset(offsets[added].x, offsets[added].y, offsets[added].z);
      sum += offset;
      squares.noalias() += offset * offset.transpose();
    }
    shapes[scales++] = shape_of(sum, squares, neighbours);
  }
  const std::span<const Shape> known(shapes.data(), scales);
  for (std::size_t s = scales; s-- > 0;) {
    if (known[s].is_line || (strips == Strips::Noise && turns(known, s)))
      return s + 1 < scales ? kSurfaceScales[s + 1] : kNoSurface;
  }
  return 0;
}

bool lies_in_grid(std::span<const glm::dvec3> offsets) {
  return offsets.size() >= 4 && glm::length(offsets[3]) <= kGridTolerance * glm::length(offsets[0]);
}

}  // namespace relief
