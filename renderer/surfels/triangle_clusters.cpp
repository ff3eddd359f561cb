#include "renderer/surfels/triangle_clusters.h"

#include <tbb/parallel_invoke.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace relief {
namespace {

/// Deeper than any scan's tree; hostile points make a tree as deep as there are points, so that
/// from here on clusters are halved.
constexpr int kDeepestCluster = 64;

/// Smaller clusters are split by the thread that has them.
constexpr std::size_t kSplitInParallel = 4096;

/// A point of a cluster and how far it is along the direction of the cluster's greatest variation.
struct Placed {
  double along = 0.0;
  std::uint32_t point = 0;

  friend bool operator<(const Placed& a, const Placed& b) {
    return a.along != b.along ? a.along < b.along : a.point < b.point;
  }
};

/// The points by their offset from the plane through their centroid.
void place(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> cluster,
           std::vector<Placed>& placed) {
  glm::dvec3 centroid(0.0);
  for (const std::uint32_t k : cluster) centroid += positions[k];
  centroid /= static_cast<double>(cluster.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double largest = 0.0;  // by which small clusters are scaled, since squares of offsets vanish
  for (const std::uint32_t k : cluster) {
    const glm::dvec3 d = glm::abs(positions[k] - centroid);
    largest = std::max({largest, d.x, d.y, d.z});
  }
  const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
  for (const std::uint32_t k : cluster) {
    const glm::dvec3 d = (positions[k] - centroid) * scale;
    const Eigen::Vector3d v(d.x, d.y, d.z);
    scatter.noalias() += v * v.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d greatest = solver.eigenvectors().col(2);
  const glm::dvec3 direction(greatest.x(), greatest.y(), greatest.z());
  placed.clear();
  for (const std::uint32_t k : cluster)
    placed.push_back({glm::dot((positions[k] - centroid) * scale, direction), k});
}

/// How many of n points go to the lower side, of which `below` lie below the plane: the nearest
/// number that leaves a multiple of three on one side. n is at least 4.
std::size_t choose_lower(std::size_t n, std::size_t below) {
  const auto distance = [below](std::size_t count) {
    return count > below ? count - below : below - count;
  };
  std::size_t best = 3;
  const std::size_t from = below > 3 ? below - 3 : 1;
  for (std::size_t count = from; count < n && count <= below + 3; ++count) {
    const bool suits = count % 3 == 0 || (n - count) % 3 == 0;
    if (suits && distance(count) < distance(best)) best = count;
  }
  return best;
}

/// Returns the last point of the lower side, which has `count` points.
Placed last_of_lower(const std::vector<Placed>& placed, std::size_t below, std::size_t count) {
  const std::size_t moved = count > below ? count - below : below - count;
  if (moved > 2) {  // deeper than kDeepestCluster
    std::vector<Placed> sorted = placed;
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(count - 1);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  }
  // All that are below, and then one more or one fewer at a time.
  const auto is_below = [](const Placed& p) { return p.along < 0.0; };
  Placed last{-std::numeric_limits<double>::infinity(), 0};
  for (const Placed& p : placed) {
    if (is_below(p) && last < p) last = p;
  }
  for (std::size_t m = 0; m < moved; ++m) {
    const Placed* next = nullptr;
    for (const Placed& p : placed) {
      const bool is_next = count > below ? last < p && (next == nullptr || p < *next)
                                         : p < last && (next == nullptr || *next < p);
      if (is_next) next = &p;
    }
    assert(next != nullptr && "there are points on both sides");
    last = *next;
  }
  return last;
}

struct Splitter {
  std::span<const glm::dvec3> positions;
  std::span<std::uint32_t> order;
  std::vector<std::uint8_t>& begins;  // of a slot: whether a cluster begins there
  Progress& progress;

  /// Moves the cluster's lower side to its front; returns how many points that has.
  std::size_t split(std::span<std::uint32_t> cluster, int depth) const {
    std::vector<Placed> placed;
    placed.reserve(cluster.size());
    place(positions, cluster, placed);
    const auto below = static_cast<std::size_t>(
        std::ranges::count_if(placed, [](const Placed& p) { return p.along < 0.0; }));
    const std::size_t wanted = depth < kDeepestCluster ? below : cluster.size() / 2;
    const std::size_t count = choose_lower(cluster.size(), wanted);
    const Placed last = last_of_lower(placed, below, count);
    std::size_t lower = 0;
    std::size_t upper = count;
    for (const Placed& p : placed) cluster[last < p ? upper++ : lower++] = p.point;
    return count;
  }

  /// `is_top`: the cluster is a part of one that was split in parallel, or the whole.
  void add(std::size_t first, std::size_t count, int depth, bool is_top) const {
    begins[first] = 1;
    if (count < kSplitInParallel && is_top) progress.advance(count);
    if (count <= 3 || (is_top && progress.cancelled())) return;
    const std::size_t lower = split(order.subspan(first, count), depth);
    const bool in_parallel = count >= kSplitInParallel;
    const auto add_lower = [&] { add(first, lower, depth + 1, in_parallel); };
    const auto add_upper = [&] { add(first + lower, count - lower, depth + 1, in_parallel); };
    if (in_parallel) return tbb::parallel_invoke(add_lower, add_upper);
    add_lower();
    add_upper();
  }
};

}  // namespace

Result<PointClusters> find_triangle_clusters(std::span<const glm::dvec3> positions,
                                             Progress& progress) {
  progress.begin_stage("surfel triangles", positions.size());
  PointClusters clusters;
  clusters.order.resize(positions.size());
  std::iota(clusters.order.begin(), clusters.order.end(), 0U);
  std::vector<std::uint8_t> begins(positions.size());
  if (!positions.empty()) {
    Splitter{positions, clusters.order, begins, progress}.add(0, positions.size(), 0, true);
    if (progress.cancelled()) return interrupted_error();
  }
  for (std::uint32_t slot = 0; slot < begins.size(); ++slot) {
    if (begins[slot] != 0) clusters.first.push_back(slot);
  }
  clusters.first.push_back(static_cast<std::uint32_t>(positions.size()));
  return clusters;
}

}  // namespace relief
