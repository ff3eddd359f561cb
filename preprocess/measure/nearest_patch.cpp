#include "preprocess/measure/nearest_patch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>

#include "preprocess/measure/patch_distance.h"

namespace relief {
namespace {

constexpr std::uint32_t kLeafPatches = 4;

glm::dvec3 middle_of(const Bounds& box) {
  return (box.min + box.max) / 2.0;
}

constexpr double kNoSample = std::numeric_limits<double>::infinity();

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
  double best = kNoSample;
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
  if (to_sample == kNoSample) return std::nullopt;
  return to_sample * patch.spacing;
}

NearestPatch::Reach NearestPatch::reach_of(const Patch& patch) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double steepest = 0.0;  // along an edge between two samples, in steps of height a cell
  const auto compare = [&](std::int32_t a, std::int32_t b) {
    if (a != kHole && b != kHole)
      steepest = std::max(steepest, std::abs(static_cast<double>(a) - static_cast<double>(b)));
  };
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::int32_t h = patch.at(i, j);
      if (h == kHole) continue;
      low = std::min(low, static_cast<double>(h));
      high = std::max(high, static_cast<double>(h));
      if (i + 1 < patch.width) compare(h, patch.at(i + 1, j));
      if (j + 1 < patch.height) compare(h, patch.at(i, j + 1));
    }
  }
  Reach reach;
  if (low > high) return reach;
  // A cell's missing corner continues the plane of the others, one edge beyond the samples.
  low = (low - steepest) * patch.height_step;
  high = (high + steepest) * patch.height_step;
  for (const double x : {0.0, (patch.width - 1.0) * patch.spacing}) {
    for (const double y : {0.0, (patch.height - 1.0) * patch.spacing}) {
      for (const double z : {low, high})
        extend(reach.box, patch.origin + patch.axes * glm::dvec3(x, y, z));
    }
  }
  const double slope = steepest * patch.height_step / patch.spacing;
  reach.steepness = std::sqrt(1.0 + 2.0 * slope * slope);  // both slopes of a cell are that at most
  return reach;
}

double NearestPatch::least_distance(const Reach& reach, glm::dvec3 point) {
  if (reach.box.empty()) return std::numeric_limits<double>::infinity();
  const glm::dvec3 outside = point - glm::clamp(point, reach.box.min, reach.box.max);
  // Less by what rounding could add.
  return glm::length(outside) / reach.steepness * (1.0 - 1e-9);
}

NearestPatch::NearestPatch(const std::vector<Patch>& patches)
    : patches_(patches), order_(patches.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Reach> reaches(patches.size());
  tbb::parallel_for(std::size_t{0}, reaches.size(),
                    [&](std::size_t p) { reaches[p] = reach_of(patches[p]); });
  std::erase_if(order_, [&](std::uint32_t p) { return reaches[p].box.empty(); });
  nodes_.emplace_back();
  if (!order_.empty()) build(reaches, 0, 0, static_cast<std::uint32_t>(order_.size()));
}

void NearestPatch::build(const std::vector<Reach>& reaches, std::uint32_t node, std::uint32_t first,
                         std::uint32_t count) {
  Reach reach;
  for (std::uint32_t k = first; k < first + count; ++k) {
    extend(reach.box, reaches[order_[k]].box.min);
    extend(reach.box, reaches[order_[k]].box.max);
    reach.steepness = std::max(reach.steepness, reaches[order_[k]].steepness);
  }
  nodes_[node].reach = reach;
  if (count <= kLeafPatches) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const glm::dvec3 size = reach.box.max - reach.box.min;
  const glm::length_t axis =
      size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    return middle_of(reaches[a].box)[axis] < middle_of(reaches[b].box)[axis];
  });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children;
  build(reaches, children, first, half);
  build(reaches, children + 1, first + half, count - half);
}

double NearestPatch::distance(glm::dvec3 point, double best) const {
  // Halving gives a depth of at most 32; each step pushes one node more than it takes.
  std::array<std::uint32_t, 64> waiting{};
  std::size_t depth = 0;
  if (!order_.empty()) waiting[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[waiting[--depth]];
    if (least_distance(node.reach, point) >= best) continue;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      best = std::min(best, distance_to_patch(patches_[order_[k]], point).value_or(best));
    if (node.count > 0) continue;
    // The nearer child is looked at first.
    const bool left_is_nearer = least_distance(nodes_[node.first].reach, point) <=
                                least_distance(nodes_[node.first + 1].reach, point);
    waiting[depth++] = node.first + (left_is_nearer ? 1 : 0);
    waiting[depth++] = node.first + (left_is_nearer ? 0 : 1);
  }
  return best;
}

}  // namespace relief
