#include "preprocess/measure.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "preprocess/nearest_patch.h"

namespace relief {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Points within this many spacings of a cell are not compared with seams: few are nearer to one.
constexpr double kSeamsMatter = 0.02;

// Height and slope of the surface over a cell, in grid units.
struct CellSurface {
  double height;
  double slope_x;
  double slope_y;
};

// fx, fy: position within the cell; h: heights of its corners (0,0) (1,0) (0,1) (1,1), NaN for
// holes.
std::optional<CellSurface> over_cell(const double (&h)[4], double fx, double fy) {
  int holes = 0;
  int hole = -1;
  for (int c = 0; c < 4; ++c) {
    if (!std::isnan(h[c])) continue;
    ++holes;
    hole = c;
  }
  if (holes == 0) {
    const double low = h[0] + fx * (h[1] - h[0]);
    const double high = h[2] + fx * (h[3] - h[2]);
    return CellSurface{low + fy * (high - low), (1 - fy) * (h[1] - h[0]) + fy * (h[3] - h[2]),
                       high - low};
  }
  if (holes != 1) return std::nullopt;
  // The missing corner continues the plane of the other three.
  double full[4] = {h[0], h[1], h[2], h[3]};
  full[hole] = full[hole ^ 1] + full[hole ^ 2] - full[hole ^ 3];
  return over_cell(full, fx, fy);
}

double height_at(const Patch& patch, std::int64_t i, std::int64_t j) {
  if (i < 0 || j < 0 || i >= patch.width || j >= patch.height) return std::nan("");
  const std::int32_t h = patch.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
  return h == kHole ? std::nan("") : h * patch.height_step / patch.spacing;
}

double nearest_sample(const Patch& patch, double x, double y, double z) {
  double best = kFar;
  const auto ci = static_cast<std::int64_t>(std::lround(x));
  const auto cj = static_cast<std::int64_t>(std::lround(y));
  for (std::int64_t j = cj - 2; j <= cj + 2; ++j) {
    for (std::int64_t i = ci - 2; i <= ci + 2; ++i) {
      const double h = height_at(patch, i, j);
      if (std::isnan(h)) continue;
      const glm::dvec3 d(x - static_cast<double>(i), y - static_cast<double>(j), z - h);
      best = std::min(best, glm::dot(d, d));
    }
  }
  return std::sqrt(best);
}

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

std::optional<double> distance_to_patch(const Patch& patch, glm::dvec3 point) {
  const glm::dvec3 local = glm::transpose(patch.axes) * (point - patch.origin) / patch.spacing;
  // Two cells around the grid are the search radius.
  if (local.x < -3.0 || local.y < -3.0 || local.x > patch.width + 2.0 ||
      local.y > patch.height + 2.0) {
    return std::nullopt;
  }
  const auto i = static_cast<std::int64_t>(std::floor(local.x));
  const auto j = static_cast<std::int64_t>(std::floor(local.y));
  const double corners[4] = {height_at(patch, i, j), height_at(patch, i + 1, j),
                             height_at(patch, i, j + 1), height_at(patch, i + 1, j + 1)};
  if (const auto cell =
          over_cell(corners, local.x - static_cast<double>(i), local.y - static_cast<double>(j))) {
    const double steep =
        std::sqrt(1.0 + cell->slope_x * cell->slope_x + cell->slope_y * cell->slope_y);
    return std::abs(local.z - cell->height) / steep * patch.spacing;
  }
  const double to_sample = nearest_sample(patch, local.x, local.y, local.z);
  if (to_sample == kFar) return std::nullopt;
  return to_sample * patch.spacing;
}

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
