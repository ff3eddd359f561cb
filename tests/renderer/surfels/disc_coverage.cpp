#include "tests/renderer/surfels/disc_coverage.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "common/neighbours/position_tree.h"

namespace relief::test {
namespace {

/// The scale from which on a disc covers a sample; above kMostScale: never.
double scale_from(glm::dvec3 sample, glm::dvec3 up, glm::dvec3 centre, glm::dvec3 normal,
                  double radius) {
  constexpr double kNever = 2.0 * DiscCoverage::kMostScale;
  const double facing = glm::dot(up, normal);
  if (facing <= 0.1) return kNever;  // the line all but misses the plane
  const double along = glm::dot(centre - sample, normal) / facing;
  const glm::dvec3 met = sample + along * up;
  return std::max(glm::distance(met, centre), std::abs(along)) / radius;
}

void lower(float& value, float to) {
  std::atomic_ref<float> shared(value);
  float now = shared.load(std::memory_order_relaxed);
  while (to < now && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

}  // namespace

DiscCoverage::DiscCoverage(const SurfaceSamples& surface, std::span<const glm::dvec3> centres,
                           std::span<const glm::vec3> normals, std::span<const double> diameters)
    : needed_(surface.positions.size(), std::numeric_limits<float>::infinity()),
      covers_(kBins + 1) {
  const PositionTree tree(surface.positions);
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, centres.size(), 256), [&](const Range& range) {
    std::vector<std::uint64_t> covers(kBins + 1);
    std::array<double, PositionTree::kLeafSize> squared;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const double radius = diameters[k] / 2.0;
      const double reach = 2.0 * kMostScale * kMostScale * radius * radius;
      const auto look_at_leaf = [&](std::size_t first, std::size_t count) {
        tree.squared_distances(centres[k], first, squared);
        for (std::size_t m = 0; m < count; ++m) {
          if (squared[m] >= reach) continue;
          const std::uint32_t s = tree.index(first + m);
          const double scale = scale_from(tree.at(first + m), surface.normals[s], centres[k],
                                          glm::dvec3(normals[k]), radius);
          if (!(scale < kMostScale)) continue;
          ++covers[static_cast<std::size_t>(scale / kMostScale * kBins)];
          lower(needed_[s], static_cast<float>(scale));
        }
      };
      tree.visit_near(
          centres[k], [reach] { return reach; }, look_at_leaf);
    }
    for (std::size_t bin = 0; bin < covers.size(); ++bin)
      std::atomic_ref(covers_[bin]).fetch_add(covers[bin], std::memory_order_relaxed);
  });
  sorted_ = needed_;
  tbb::parallel_sort(sorted_.begin(), sorted_.end());
}

double DiscCoverage::uncovered(double scale) const {
  const auto after = std::upper_bound(sorted_.begin(), sorted_.end(), static_cast<float>(scale));
  return static_cast<double>(sorted_.end() - after) / static_cast<double>(sorted_.size());
}

double DiscCoverage::overlap(double scale) const {
  const auto bins = static_cast<std::size_t>(scale / kMostScale * kBins);
  std::uint64_t pairs = 0;
  for (std::size_t bin = 0; bin < std::min(bins, kBins); ++bin) pairs += covers_[bin];
  return static_cast<double>(pairs) / static_cast<double>(sorted_.size());
}

double DiscCoverage::closing(double share) const {
  const auto left = static_cast<std::size_t>(share * static_cast<double>(sorted_.size()));
  return std::min(kMostScale,
                  double{sorted_[sorted_.size() - 1 - std::min(left, sorted_.size() - 1)]});
}

}  // namespace relief::test
