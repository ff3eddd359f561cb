#include "preprocess/points/stray_points.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "preprocess/points/median.h"

namespace relief {
namespace {

// The tip of a cone or the corner of a cube is a spacing off the plane of its neighbours.
constexpr double kOffInSpacings = 2.0;
constexpr double kOffInDeviations = 4.0;
// At the border of a surface a point is 1.4 times as far from its neighbours as they are. Where the
// density of a scan jumps it may be several times as far, but is on their plane.
constexpr double kLoneInSpacings = 2.0;
constexpr double kLoneOffInSpacings = 0.5;
// Neighbours on a crease of 90 degrees are off their plane by 0.19 of the eighth's distance (rms),
// those in a ball by 0.45. Where a scan becomes sparse, features are as small as its spacing, too.
constexpr double kBallShare = 0.28;
constexpr float kSparseInMedians = 4.0F;
constexpr std::uint32_t kEighth = 8;

struct Plane {
  glm::dvec3 middle{0.0};
  glm::dvec3 normal{0.0};
  double rms = 0.0;  ///< distance of the points to it
};

Plane plane_of(const std::vector<glm::dvec3>& positions, std::span<const std::uint32_t> points) {
  Plane plane;
  const auto count = static_cast<double>(points.size());
  const glm::dvec3 base = positions[points.front()];
  for (const std::uint32_t j : points) plane.middle += positions[j] - base;
  plane.middle = base + plane.middle / count;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const std::uint32_t j : points) {
    const glm::dvec3 d = positions[j] - plane.middle;
    const Eigen::Vector3d v(d.x, d.y, d.z);
    moments.noalias() += v * v.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(moments / count);
  const Eigen::Vector3d n = solver.eigenvectors().col(0);
  plane.normal = {n.x(), n.y(), n.z()};
  plane.rms = std::sqrt(std::max(solver.eigenvalues()[0], 0.0));
  return plane;
}

}  // namespace

std::vector<std::uint8_t> find_stray_points(const std::vector<glm::dvec3>& positions,
                                            const NeighbourGraph& graph) {
  std::vector<std::uint8_t> stray(positions.size(), 0);
  if (graph.k < kEighth) return stray;
  std::vector<float> to_eighth(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    to_eighth[i] =
        static_cast<float>(glm::distance(positions[i], positions[graph.of(i)[kEighth - 1]]));
  }
  const float sparse = kSparseInMedians * median_of(to_eighth);
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    const auto neighbours = graph.of(i);
    const Plane plane = plane_of(positions, neighbours);
    std::vector<float> spacings;
    for (const std::uint32_t j : neighbours) spacings.push_back(graph.spacing[j]);
    const double spacing = median_of(std::move(spacings));
    const double own_spacing = std::sqrt(std::numbers::pi / kEighth) * to_eighth[i];
    const double off = std::abs(glm::dot(positions[i] - plane.middle, plane.normal));
    const bool is_off = off > kOffInSpacings * spacing && off > kOffInDeviations * plane.rms;
    const bool is_lone =
        own_spacing > kLoneInSpacings * spacing && off > kLoneOffInSpacings * spacing;
    const bool is_in_ball = to_eighth[i] > sparse && plane.rms > kBallShare * to_eighth[i];
    stray[i] = is_off || is_lone || is_in_ball ? 1 : 0;
  });
  return stray;
}

}  // namespace relief
