#include "preprocess/measure/measure.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "preprocess/measure/nearest_patch.h"
#include "preprocess/measure/patch_distance.h"

namespace relief {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Points within this many spacings of a cell are not compared with seams: few are nearer to one.
constexpr double kSeamsMatter = 0.02;

double distance_or_far(const Patch& patch, glm::dvec3 point) {
  return distance_to_patch(patch, point).value_or(kFar);
}

// Returns the smallest distance of a point to the patches of its neighbourhood, without `except`.
double neighbourhood_distance(const std::vector<glm::dvec3>& positions, const NeighbourGraph& graph,
                              const std::vector<std::uint32_t>& owner,
                              const std::vector<Patch>& patches, std::size_t point,
                              std::uint32_t except) {
  std::uint32_t tried[32];
  std::size_t count = 0;
  double best = kFar;
  const auto try_patch = [&](std::uint32_t patch) {
    if (patch >= patches.size() || patch == except || count == std::size(tried) ||
        std::find(tried, tried + count, patch) != tried + count) {
      return;
    }
    tried[count++] = patch;
    best = std::min(best, distance_or_far(patches[patch], positions[point]));
  };
  try_patch(owner[point]);
  for (const std::uint32_t j : graph.of(point)) try_patch(owner[j]);
  return best;
}

double largest_spacing(const std::vector<Patch>& patches) {
  double largest = 0.0;
  for (const Patch& patch : patches) largest = std::max(largest, patch.spacing);
  return largest;
}

struct Sums {
  double squared = 0.0;
  double max = 0.0;
  std::uint64_t uncovered = 0;
};

}  // namespace

std::vector<double> distances_to_patches(const std::vector<glm::dvec3>& positions,
                                         std::size_t count, const NeighbourGraph& graph,
                                         const std::vector<std::uint32_t>& owner,
                                         const std::vector<Patch>& patches) {
  constexpr auto kNoPatch = std::numeric_limits<std::uint32_t>::max();
  std::vector<double> distances(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    distances[i] = neighbourhood_distance(positions, graph, owner, patches, i, kNoPatch);
  });
  return distances;
}

void compare_with_seams(const std::vector<glm::dvec3>& positions, const std::vector<Patch>& patches,
                        const SeamDistances& seams, std::vector<double>& distances) {
  const double matters = kSeamsMatter * largest_spacing(patches);
  tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
    if (distances[i] > matters)
      distances[i] = seams.find(positions[i], distances[i]).value_or(distances[i]);
  });
}

Fidelity measure_fidelity(const std::vector<glm::dvec3>& positions,
                          const std::vector<double>& distances, const std::vector<Patch>& patches) {
  const double limit = kUncoveredInSpacings * largest_spacing(patches);
  std::optional<NearestPatch> nearest;
  if (std::ranges::any_of(distances, [limit](double d) { return d > limit; }))
    nearest.emplace(patches);
  // Fixed chunks, joined in order: floating-point sums do not depend on the number of threads.
  const Sums total = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, distances.size(), 4096), Sums{},
      [&](const tbb::blocked_range<std::size_t>& range, Sums sums) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          double d = distances[i];
          if (d > limit) d = nearest->distance(positions[i], d);
          if (d > limit) ++sums.uncovered;
          if (d == kFar) d = limit;
          sums.squared += d * d;
          sums.max = std::max(sums.max, d);
        }
        return sums;
      },
      [](const Sums& a, const Sums& b) {
        return Sums{a.squared + b.squared, std::max(a.max, b.max), a.uncovered + b.uncovered};
      });
  return {std::sqrt(total.squared / static_cast<double>(distances.size())), total.max,
          total.uncovered};
}

std::vector<std::uint8_t> find_redundant(const std::vector<glm::dvec3>& positions,
                                         const NeighbourGraph& graph,
                                         const std::vector<std::uint32_t>& owner,
                                         const std::vector<std::vector<std::uint32_t>>& own_points,
                                         const std::vector<Patch>& patches,
                                         std::size_t small_points) {
  std::vector<std::uint8_t> redundant(patches.size(), 0);
  std::vector<std::uint32_t> staying = owner;
  // Smallest first: patches are ordered by size, largest first.
  for (std::size_t p = patches.size(); p-- > 0;) {
    if (own_points[p].size() > small_points) break;
    const bool covered =
        std::all_of(own_points[p].begin(), own_points[p].end(), [&](std::uint32_t i) {
          return neighbourhood_distance(positions, graph, staying, patches, i,
                                        static_cast<std::uint32_t>(p)) <= patches[p].spacing;
        });
    if (!covered) continue;
    redundant[p] = 1;
    for (const std::uint32_t i : own_points[p]) {
      staying[i] = static_cast<std::uint32_t>(patches.size());
    }
  }
  return redundant;
}

}  // namespace relief
