#include "preprocess/nearest_patch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "preprocess/patch_distance.h"

namespace relief {
namespace {

constexpr std::uint32_t kLeafPatches = 4;

glm::dvec3 middle_of(const Bounds& box) {
  return (box.min + box.max) / 2.0;
}

}  // namespace

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
