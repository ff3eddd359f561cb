#include "renderer/surfels/cell_sizes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "common/neighbours/neighbours.h"

namespace relief {
namespace {

/// Where cells end that neighbours do not bound: at the distance of that many.
constexpr std::uint32_t kEndNeighbour = 8;

/// A convex polygon that is cut by lines; each line adds at most one corner.
class Cell {
 public:
  /// A square from -half to half.
  explicit Cell(double half)
      : corners_{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}}, count_(4) {}

  /// Leaves what is nearer to the origin than to `other`.
  void cut(glm::dvec2 other) {
    const double bound = 0.5 * glm::dot(other, other);
    std::array<glm::dvec2, kMost> kept;
    std::size_t kept_count = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const glm::dvec2 a = corners_[k];
      const glm::dvec2 b = corners_[k + 1 < count_ ? k + 1 : 0];
      const double beyond_a = glm::dot(a, other) - bound;
      const double beyond_b = glm::dot(b, other) - bound;
      if (beyond_a <= 0.0) kept[kept_count++] = a;
      if ((beyond_a <= 0.0) == (beyond_b <= 0.0)) continue;
      kept[kept_count++] = a + (b - a) * (beyond_a / (beyond_a - beyond_b));
    }
    corners_ = kept;
    count_ = kept_count;
  }

  [[nodiscard]] double reach() const {
    double squared = 0.0;
    for (std::size_t k = 0; k < count_; ++k)
      squared = std::max(squared, glm::dot(corners_[k], corners_[k]));
    return std::sqrt(squared);
  }

 private:
  static constexpr std::size_t kMost = std::size_t{2} * (4 + kSurfaceNeighbours);
  std::array<glm::dvec2, kMost> corners_;
  std::size_t count_;
};

double cell_size(const std::vector<glm::dvec3>& positions, std::size_t point,
                 std::span<const std::uint32_t> neighbours) {
  const glm::dvec3 at = positions[point];
  const double last = glm::distance(at, positions[neighbours.back()]);
  const double end = glm::distance(
      at, positions[neighbours[std::min<std::size_t>(neighbours.size(), kEndNeighbour) - 1]]);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  const auto offset = [&](std::uint32_t j) {
    const glm::dvec3 d = (positions[j] - at) / last;
    return Eigen::Vector3d(d.x, d.y, d.z);
  };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t j : neighbours) mean += offset(j);
  mean /= static_cast<double>(neighbours.size() + 1);
  scatter.noalias() += mean * mean.transpose();  // of the point itself
  for (const std::uint32_t j : neighbours) {
    const Eigen::Vector3d d = offset(j) - mean;
    scatter.noalias() += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Cell cell(2.0);
  for (const std::uint32_t j : neighbours) {
    const Eigen::Vector3d d = offset(j);
    cell.cut({d.dot(solver.eigenvectors().col(1)), d.dot(solver.eigenvectors().col(2))});
  }
  return 2.0 * std::min(cell.reach() * last, end);
}

}  // namespace

Result<std::vector<double>> find_cell_sizes(const std::vector<glm::dvec3>& positions,
                                            Progress& progress) {
  progress.begin_stage("surfel cells", positions.size());
  const NeighbourGraph graph = find_neighbours(positions, kSurfaceNeighbours);
  std::vector<double> diameters(positions.size(), 1.0);
  if (graph.k == 0) return diameters;
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, positions.size(), 1024), [&](const Range& range) {
    if (progress.cancelled()) return;
    for (std::size_t k = range.begin(); k != range.end(); ++k)
      diameters[k] = cell_size(positions, k, graph.of(k));
    progress.advance(range.size());
  });
  if (progress.cancelled()) return interrupted_error();
  return diameters;
}

}  // namespace relief
