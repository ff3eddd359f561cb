#include "renderer/surfels/sphere_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

namespace relief {
namespace {

/// Deeper than any scan's tree. Hostile positions make a tree as deep as there are surfels, so that
/// from here on nodes are halved.
constexpr int kDeepestSphere = 32;

using Slots = std::span<std::uint32_t>;

/// Moves the lower half of some surfels to the front, by their place along the longest side of
/// their box. Returns how many these are; 0 if all positions coincide.
std::size_t halve(std::span<const glm::dvec3> positions, Slots slots, bool by_count) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (const std::uint32_t k : slots) {
    low = glm::min(low, positions[k]);
    high = glm::max(high, positions[k]);
  }
  const glm::dvec3 halves = high / 2.0 - low / 2.0;
  glm::length_t axis = halves.y > halves.x ? 1 : 0;
  if (halves.z > halves[axis]) axis = 2;
  if (!(low[axis] < high[axis])) return 0;
  if (!by_count) {
    const double middle = low[axis] / 2.0 + high[axis] / 2.0;
    const auto upper = std::stable_partition(
        slots.begin(), slots.end(), [&](std::uint32_t k) { return positions[k][axis] < middle; });
    const auto count = static_cast<std::size_t>(upper - slots.begin());
    if (count > 0 && count < slots.size()) return count;
  }
  std::sort(slots.begin(), slots.end(), [&](std::uint32_t a, std::uint32_t b) {
    return positions[a][axis] != positions[b][axis] ? positions[a][axis] < positions[b][axis]
                                                    : a < b;
  });
  return slots.size() / 2;
}

/// The numbers of surfels of a node's children, in their order; 0 where there is none.
std::array<std::uint32_t, 4> divide(std::span<const glm::dvec3> positions, Slots slots,
                                    bool by_count) {
  std::array<std::uint32_t, 4> counts{};
  if (slots.size() <= SphereTree::kLeafSize) return counts;
  const std::size_t lower = halve(positions, slots, by_count);
  if (lower == 0) return counts;
  std::size_t child = 0;
  for (const Slots half : {slots.first(lower), slots.subspan(lower)}) {
    const std::size_t quarter =
        half.size() > SphereTree::kLeafSize ? halve(positions, half, by_count) : 0;
    if (quarter > 0) counts[child++] = static_cast<std::uint32_t>(quarter);
    counts[child++] = static_cast<std::uint32_t>(half.size() - quarter);
  }
  return counts;
}

/// Divides the root, then all nodes of a level at once.
bool make_nodes(std::span<const glm::dvec3> positions, SphereTree& tree, Progress& progress) {
  SphereNode root;
  root.count = static_cast<std::uint32_t>(positions.size());
  tree.nodes.push_back(root);
  std::size_t begin = 0;
  for (int level = 0; begin < tree.nodes.size(); ++level) {
    if (progress.cancelled()) return false;
    const std::size_t end = tree.nodes.size();
    std::vector<std::array<std::uint32_t, 4>> counts(end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t n) {
      const SphereNode& node = tree.nodes[n];
      counts[n - begin] = divide(positions, Slots(tree.order).subspan(node.first, node.count),
                                 level > kDeepestSphere);
    });
    for (std::size_t n = begin; n < end; ++n) {
      std::uint32_t first = tree.nodes[n].first;
      tree.nodes[n].child = static_cast<std::uint32_t>(tree.nodes.size());
      for (const std::uint32_t count : counts[n - begin]) {
        if (count == 0) break;
        ++tree.nodes[n].children;
        SphereNode child;
        child.first = first;
        child.count = count;
        first += count;
        tree.nodes.push_back(child);
      }
    }
    begin = end;
  }
  return true;
}

/// The cone of the normals.
void find_cone(const SphereSurfels& surfels, std::span<const std::uint32_t> slots,
               SphereNode& node) {
  glm::dvec3 sum(0.0);
  bool all_units = true;
  for (const std::uint32_t k : slots) {
    const glm::dvec3 normal(surfels.normals[k]);
    all_units = all_units && std::abs(glm::dot(normal, normal) - 1.0) < 1e-3;
    if (all_units) sum += normal;
  }
  const double length = glm::length(sum);
  node.axis = length > 0.0 ? glm::vec3(sum / length) : glm::vec3(0.0F, 0.0F, 1.0F);
  node.cos_angle = -1.0F;
  if (!all_units || !(length > 0.0)) return;
  double widest = 0.0;
  for (const std::uint32_t k : slots) {
    const double cosine = glm::dot(glm::dvec3(node.axis), glm::dvec3(surfels.normals[k]));
    const double spread = surfels.spreads.empty() ? 0.0 : double{surfels.spreads[k]};
    widest = std::max(widest, std::acos(std::clamp(cosine, -1.0, 1.0)) + spread);
  }
  // 0.001 radians, more than the normals' and the cosine's rounding.
  widest += 1e-3;
  if (widest < std::numbers::pi) node.cos_angle = static_cast<float>(std::cos(widest));
}

/// The sphere, and the disc of the mean surfel.
void find_sphere(const SphereSurfels& surfels, std::span<const std::uint32_t> slots,
                 SphereNode& node) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  node.mean = glm::dvec3(0.0);
  for (const std::uint32_t k : slots) {
    low = glm::min(low, surfels.positions[k] - surfels.reaches[k]);
    high = glm::max(high, surfels.positions[k] + surfels.reaches[k]);
    node.mean += surfels.positions[k] / static_cast<double>(slots.size());
  }
  node.centre = low / 2.0 + high / 2.0;
  const glm::dvec3 axis(node.axis);
  for (const std::uint32_t k : slots) {
    const double reach = surfels.reaches[k];
    node.radius = std::max(node.radius, glm::distance(surfels.positions[k], node.centre) + reach);
    const glm::dvec3 d = surfels.positions[k] - node.mean;
    node.mean_radius =
        std::max(node.mean_radius, glm::length(d - axis * glm::dot(d, axis)) + reach);
  }
}

}  // namespace

Result<SphereTree> build_sphere_tree(const SphereSurfels& surfels, Progress& progress) {
  SphereTree tree;
  if (surfels.positions.empty()) return tree;
  progress.begin_stage("surfel spheres", 0);
  tree.order.resize(surfels.positions.size());
  std::iota(tree.order.begin(), tree.order.end(), 0U);
  if (!make_nodes(surfels.positions, tree, progress)) return interrupted_error();
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, tree.nodes.size(), 64), [&](const Range& range) {
    if (progress.cancelled()) return;
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      SphereNode& node = tree.nodes[n];
      const auto slots = std::span<const std::uint32_t>(tree.order).subspan(node.first, node.count);
      find_cone(surfels, slots, node);
      find_sphere(surfels, slots, node);
    }
  });
  if (progress.cancelled()) return interrupted_error();
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children come after their parents
    SphereNode& node = tree.nodes[n];
    if (node.count > 1) node.least_mean_radius = node.mean_radius;
    for (std::uint32_t c = node.child; c < node.child + node.children; ++c)
      node.least_mean_radius = std::min(node.least_mean_radius, tree.nodes[c].least_mean_radius);
  }
  return tree;
}

}  // namespace relief
