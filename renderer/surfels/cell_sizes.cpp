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

#include "common/neighbours/nearest_search.h"
#include "common/neighbours/neighbours.h"
#include "common/neighbours/position_tree.h"

namespace relief {
namespace {

using Range = tbb::blocked_range<std::uint32_t>;

/// Neighbours that are looked at where the nearest 16 are too few.
constexpr std::uint32_t kMoreNeighbours = 128;

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
    std::copy_n(kept.begin(), kept_count, corners_.begin());
    count_ = kept_count;
  }

  [[nodiscard]] double reach() const {
    double squared = 0.0;
    for (std::size_t k = 0; k < count_; ++k)
      squared = std::max(squared, glm::dot(corners_[k], corners_[k]));
    return std::sqrt(squared);
  }

 private:
  /// Twice what exact arithmetic needs.
  static constexpr std::size_t kMost = std::size_t{2} * (4 + kSurfaceNeighbours + kMoreNeighbours);
  std::array<glm::dvec2, kMost> corners_;
  std::size_t count_;
};

/// Neighbours of one surface have normals within 75 degrees; with 60, folds of scans lost 0.9 dB.
/// Those beyond 120 are of the far side of something thin, the rest beyond an edge. Between 60 and
/// 75 degrees they may be either: cells have none of them in their plane, unless there is no other,
/// and do not end half-way to them.
constexpr double kOwnCosine = 0.25;
constexpr double kSurelyOwnCosine = 0.5;
constexpr double kFarCosine = -0.5;
/// A cell needs that many neighbours of its own surface; where it has fewer among its nearest,
/// because another surface beside it is denser, they are looked for among kMoreNeighbours.
constexpr std::size_t kFewestOwn = 5;
constexpr std::size_t kFewestOfPlane = 3;

using Neighbours = std::span<const std::uint32_t>;

/// The points among which cells are found.
struct Surface {
  std::span<const glm::dvec3> positions;
  std::span<const glm::vec3> normals;  ///< empty: all are of one surface

  [[nodiscard]] double cosine(std::uint32_t a, std::uint32_t b) const {
    return normals.empty() ? 1.0 : double{glm::dot(normals[a], normals[b])};
  }

  /// The nearest of `neighbours` that are of one surface with a point.
  void own_of(std::uint32_t point, Neighbours neighbours, std::vector<std::uint32_t>& own) const {
    own.clear();
    for (const std::uint32_t j : neighbours)
      if (own.size() < kSurfaceNeighbours && cosine(point, j) > kOwnCosine) own.push_back(j);
  }
};

/// The cell of `point` among `own`, in the plane through them. Those of `beside` that are beyond an
/// edge, and those that may be, bound it where they lie. Both: nearest first.
double cell_size(const Surface& surface, std::uint32_t point, Neighbours own, Neighbours beside) {
  const glm::dvec3 at = surface.positions[point];
  const auto distance = [&](std::size_t m) {
    return glm::distance(at, surface.positions[own[std::min(own.size() - 1, m)]]);
  };
  const double last = distance(own.size() - 1);
  const auto offset = [&](std::uint32_t j) {
    const glm::dvec3 d = (surface.positions[j] - at) / last;
    return Eigen::Vector3d(d.x, d.y, d.z);
  };
  const auto is_surely_own = [&](std::uint32_t j) {
    return surface.cosine(point, j) > kSurelyOwnCosine;
  };
  const auto sure = static_cast<std::size_t>(std::ranges::count_if(own, is_surely_own));
  const bool takes_all = sure < kFewestOfPlane;
  const double count = static_cast<double>((takes_all ? own.size() : sure) + 1);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const std::uint32_t j : own)
    if (takes_all || is_surely_own(j)) mean += offset(j) / count;
  Eigen::Matrix3d scatter = mean * mean.transpose();  // of the point itself
  for (const std::uint32_t j : own) {
    if (!takes_all && !is_surely_own(j)) continue;
    const Eigen::Vector3d d = offset(j) - mean;
    scatter.noalias() += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const auto in_plane = [&](std::uint32_t j) {
    const Eigen::Vector3d d = offset(j);
    return glm::dvec2(d.dot(solver.eigenvectors().col(1)), d.dot(solver.eigenvectors().col(2)));
  };
  Cell cell(2.0);
  for (const std::uint32_t j : own) cell.cut((is_surely_own(j) ? 1.0 : 2.0) * in_plane(j));
  for (const std::uint32_t j : beside) {
    const double cosine = surface.cosine(point, j);
    if (cosine <= kOwnCosine && cosine > kFarCosine) cell.cut(2.0 * in_plane(j));
  }
  return 2.0 * std::min(cell.reach() * last, distance(kEndNeighbour - 1));
}

/// Cells of points that have few of their own surface among their nearest neighbours.
void find_among_more(const std::vector<glm::dvec3>& positions, const Surface& surface,
                     const std::vector<std::uint8_t>& has_few, const Progress& progress,
                     std::vector<double>& diameters) {
  const PositionTree tree(positions);
  const std::uint32_t most = std::min(kMoreNeighbours, tree.size() - 1);
  tbb::parallel_for(Range(0, tree.size(), 1024), [&](const Range& range) {
    NearestSearch nearest(tree, most);
    std::vector<std::uint32_t> found(most);
    std::vector<std::uint32_t> own;
    for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
      const std::uint32_t k = tree.index(slot);
      if (has_few[k] == 0) continue;
      if (progress.cancelled()) return;
      nearest.find(slot);
      for (std::size_t m = 0; m < most; ++m) found[m] = tree.index(nearest.slot(m));
      surface.own_of(k, found, own);
      if (own.size() < kFewestOfPlane)
        own.assign(found.begin(), found.begin() + std::min(most, kSurfaceNeighbours));
      diameters[k] = cell_size(surface, k, own, {});
    }
  });
}

}  // namespace

Result<std::vector<double>> find_cell_sizes(const std::vector<glm::dvec3>& positions,
                                            std::span<const glm::vec3> normals,
                                            Progress& progress) {
  progress.begin_stage("surfel cells", positions.size());
  const NeighbourGraph graph = find_neighbours(positions, kSurfaceNeighbours);
  std::vector<double> diameters(positions.size(), 1.0);
  if (graph.k == 0) return diameters;
  const Surface surface{positions, normals};
  const std::size_t wanted = std::min<std::size_t>(kFewestOwn, graph.k);
  std::vector<std::uint8_t> has_few(positions.size(), 0);
  tbb::parallel_for(Range(0, static_cast<std::uint32_t>(positions.size()), 1024),
                    [&](const Range& range) {
                      if (progress.cancelled()) return;
                      std::vector<std::uint32_t> own;
                      for (std::uint32_t k = range.begin(); k != range.end(); ++k) {
                        surface.own_of(k, graph.of(k), own);
                        has_few[k] = own.size() < wanted ? 1 : 0;
                        if (has_few[k] == 0) diameters[k] = cell_size(surface, k, own, graph.of(k));
                      }
                      progress.advance(range.size());
                    });
  if (std::ranges::find(has_few, 1) != has_few.end())
    find_among_more(positions, surface, has_few, progress, diameters);
  if (progress.cancelled()) return interrupted_error();
  return diameters;
}

}  // namespace relief
