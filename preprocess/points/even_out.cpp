#include "preprocess/points/even_out.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "common/image/srgb.h"
#include "common/neighbours/nearest_search.h"
#include "common/neighbours/neighbours.h"
#include "common/neighbours/position_tree.h"
#include "common/neighbours/radius_search.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/points/no_point.h"
#include "preprocess/points/sampling.h"

namespace relief {
namespace {

// Where only far more neighbours show a surface, points are merged first that are as near as so
// many would be apart: a third as near, or less, as they are merged in the end.
constexpr std::uint32_t kCoarse = 32;

// A line of 32 has a tenth of its points left, a strip a third. Frames by the hundred take two
// rounds.
constexpr int kMostRounds = 4;

/// The nearest neighbours of one point after another.
class Neighbourhood {
 public:
  Neighbourhood(const PositionTree& tree, std::uint32_t neighbours)
      : tree_(tree), nearest_(tree, neighbours), offsets_(neighbours) {}

  void find(std::uint32_t slot) {
    slot_ = slot;
    nearest_.find(slot);
    for (std::size_t m = 0; m < offsets_.size(); ++m)
      offsets_[m] = tree_.at(nearest_.slot(m)) - tree_.at(slot);
  }

  /// Whether a position is as near as the last neighbour.
  [[nodiscard]] bool reaches(std::uint32_t slot) const {
    const glm::dvec3 offset = tree_.at(slot) - tree_.at(slot_);
    return glm::dot(offset, offset) <= nearest_.squared(offsets_.size() - 1);
  }

  /// How far from the point others are merged into it; 0 if the neighbours lie in no lines.
  [[nodiscard]] double merge_radius(Strips strips) const {
    const std::uint32_t scale = first_surface_scale(offsets_, strips);
    if (scale == 0 || scale == kNoSurface) return 0.0;
    return std::sqrt(std::numbers::pi * nearest_.squared(scale - 1) / kSurfaceNeighbours);
  }

  /// The distance of points if 32 of them filled a disc, if it takes many more to show a surface;
  /// else 0.
  [[nodiscard]] double coarse_radius(Strips strips) const {
    if (first_surface_scale(offsets_, strips) < kCoarseScale) return 0.0;
    return std::sqrt(std::numbers::pi * nearest_.squared(kCoarse - 1) / kCoarse);
  }

  /// The mean of those neighbours' radii that are not 0; 0 if few are.
  [[nodiscard]] double mean_radius(const std::vector<double>& by_slot) const {
    double sum = 0.0;
    std::size_t in_lines = 0;
    for (std::size_t m = 0; m < offsets_.size(); ++m) {
      const double radius = by_slot[nearest_.slot(m)];
      sum += radius;
      if (radius > 0.0) ++in_lines;
    }
    const auto least = kLeastInLines * static_cast<double>(offsets_.size());
    return static_cast<double>(in_lines) < least ? 0.0 : sum / static_cast<double>(in_lines);
  }

 private:
  const PositionTree& tree_;
  NearestSearch nearest_;
  std::vector<glm::dvec3> offsets_;
  std::uint32_t slot_ = 0;
};

/// How far from each position of the tree others are merged into it, by slot; 0 where it does not
/// lie in a line.
std::vector<double> radii_in_lines(const PositionTree& tree, Sampling sampling,
                                   Progress& progress) {
  std::vector<double> by_slot(tree.size());
  const auto find = [&](const tbb::blocked_range<std::uint32_t>& range) {
    if (progress.cancelled()) return;
    Neighbourhood neighbourhood(tree, sampling.scale);
    for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
      neighbourhood.find(slot);
      by_slot[slot] = neighbourhood.merge_radius(sampling.strips);
    }
    progress.advance(range.size());
  };
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, tree.size(), 1024), find);
  return by_slot;
}

// Positions beside each other in the tree that share a search where their own shows no line, and
// where it takes many to show a surface.
constexpr std::uint32_t kShared = 8;
constexpr std::uint32_t kCoarseShared = 32;

/// Calls visit(neighbourhood, first, end) for groups of slots. `visit` may find the neighbours of
/// any slot.
template <class Visit>
void for_each_group(const PositionTree& tree, std::uint32_t size, std::uint32_t neighbours,
                    const Visit& visit, Progress& progress) {
  const std::uint32_t groups = (tree.size() + size - 1) / size;
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, groups, 128), [&](const auto& range) {
    if (progress.cancelled()) return;
    Neighbourhood neighbourhood(tree, neighbours);
    for (std::uint32_t group = range.begin(); group != range.end(); ++group) {
      const std::uint32_t first = size * group;
      const std::uint32_t end = std::min(first + size, tree.size());
      visit(neighbourhood, first, end);
    }
    progress.advance(size * range.size());
  });
}

/// The radii where there are some; else those around, as noise hides some lines. By slot.
std::vector<double> radii_around(const PositionTree& tree, const std::vector<double>& in_lines,
                                 std::uint32_t neighbours, Progress& progress) {
  std::vector<double> by_slot = in_lines;
  const auto fill = [&](Neighbourhood& around, std::uint32_t first, std::uint32_t end) {
    const auto own = std::span(in_lines).subspan(first, end - first);
    if (std::ranges::find(own, 0.0) == own.end()) return;
    around.find((first + end) / 2);
    const double radius = around.mean_radius(in_lines);
    for (std::uint32_t slot = first; slot < end; ++slot) {
      if (in_lines[slot] == 0.0 && around.reaches(slot)) by_slot[slot] = radius;
    }
  };
  for_each_group(tree, kShared, neighbours, fill, progress);
  return by_slot;
}

/// How far from each position others are merged into it where it takes many to show a surface; else
/// 0. By slot.
std::vector<double> coarse_radii(const PositionTree& tree, Strips strips, Progress& progress) {
  std::vector<double> by_slot(tree.size());
  const auto fill = [&](Neighbourhood& around, std::uint32_t first, std::uint32_t end) {
    around.find((first + end) / 2);
    const double radius = around.coarse_radius(strips);
    for (std::uint32_t slot = first; slot < end; ++slot) {
      if (around.reaches(slot)) by_slot[slot] = radius;
    }
  };
  for_each_group(tree, kCoarseShared, largest_scale(tree.size()), fill, progress);
  return by_slot;
}

/// How far from each point others are merged into it; 0 where points do not lie in lines.
std::vector<double> merge_radii(const std::vector<glm::dvec3>& positions, Sampling sampling,
                                Progress& progress) {
  const PositionTree tree(positions);
  std::vector<double> by_slot;
  if (sampling.is_coarse) {
    by_slot = coarse_radii(tree, sampling.strips, progress);
  } else {
    const std::uint32_t more = std::min(4 * sampling.scale, largest_scale(positions.size()));
    by_slot = radii_around(tree, radii_in_lines(tree, sampling, progress), more, progress);
  }
  std::vector<double> radii(positions.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) radii[tree.index(slot)] = by_slot[slot];
  return radii;
}

bool oppose(const Points& points, std::uint32_t a, std::uint32_t b) {
  return !points.normals.empty() && glm::dot(points.normals[a], points.normals[b]) < 0.0F;
}

/// The point that each is merged into, which may be itself.
std::vector<std::uint32_t> homes_of(const Points& points, const std::vector<double>& radii) {
  const RadiusSearch search(points.positions);
  std::vector<std::uint32_t> home(points.size(), kNoPoint);
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (home[i] != kNoPoint) continue;
    home[i] = i;
    if (radii[i] == 0.0) continue;
    search.find(points.positions[i], radii[i], near);
    for (const std::uint32_t j : near) {
      if (home[j] == kNoPoint && radii[j] > 0.0 && !oppose(points, i, j)) home[j] = i;
    }
  }
  return home;
}

/// Gives each point that others are merged into the means of all.
void average(Points& points, const std::vector<std::uint32_t>& home) {
  std::vector<glm::dvec3> offsets(points.size(), glm::dvec3(0.0));
  std::vector<glm::vec3> light(points.colours.size(), glm::vec3(0.0F));
  std::vector<std::uint32_t> count(points.size(), 0);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t to = home[i];
    ++count[to];
    offsets[to] += points.positions[i] - points.positions[to];
    if (!light.empty()) light[to] += linear_from_srgb8(points.colours[i]);
    if (to != i) add_normal(points, to, i);
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (count[i] < 2) continue;
    points.positions[i] += offsets[i] / static_cast<double>(count[i]);
    if (!light.empty())
      points.colours[i] = srgb8_from_linear(light[i] / static_cast<float>(count[i]));
  }
}

/// Merges once. Returns how many points were merged into others.
std::uint64_t merge(Points& points, Sampling sampling, Progress& progress) {
  progress.begin_stage("even out", (sampling.is_coarse ? 1 : 2) * points.size());
  const std::vector<double> radii = merge_radii(points.positions, sampling, progress);
  if (progress.cancelled()) return 0;
  const std::vector<std::uint32_t> home = homes_of(points, radii);
  std::vector<std::uint8_t> merged(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) merged[i] = home[i] == i ? 0 : 1;
  const auto kept = static_cast<std::size_t>(std::ranges::count(merged, 0));
  if (kept < kMinSurfacePoints) return 0;
  average(points, home);
  return drop_points(points, merged);
}

}  // namespace

std::uint64_t even_out(Points& points, Progress& progress) {
  std::uint64_t merged = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const Sampling sampling = sampling_of(points.positions, progress);
    if (sampling.scale == 0 && !sampling.is_coarse) break;
    const std::uint64_t more = merge(points, sampling, progress);
    if (more == 0) break;
    merged += more;
  }
  return merged;
}

}  // namespace relief
