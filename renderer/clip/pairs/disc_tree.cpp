#include "renderer/clip/pairs/disc_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "common/is_finite.h"

namespace relief {
namespace {

/// Discs of a leaf, at most.
constexpr std::size_t kDiscsOfLeaf = 16;
/// Smaller subtrees are built by one thread.
constexpr std::uint32_t kSubtreeOfOneThread = 16384;

/// Squared distance of a position to a box.
double squared_to_box(glm::dvec3 from, glm::dvec3 low, glm::dvec3 high) {
  const glm::dvec3 outside = glm::max(glm::max(low - from, from - high), glm::dvec3(0.0));
  return glm::dot(outside, outside);
}

bool has_place(const SplatDiscs& discs, std::size_t splat) {
  const double length = glm::length(discs.normals[splat]);
  const bool is_ellipse = !discs.major_axes.empty();
  return is_finite(discs.centres[splat]) && length > 0.5 && length < 2.0 &&
         discs.radii[splat] > 0.0 && std::isfinite(discs.radii[splat]) &&
         (!is_ellipse || (is_finite(discs.major_axes[splat]) && discs.minor_radii[splat] > 0.0));
}

}  // namespace

DiscTree::DiscTree(const SplatDiscs& discs) {
  discs_.reserve(discs.centres.size());
  for (std::size_t s = 0; s < discs.centres.size(); ++s) {
    if (!has_place(discs, s)) continue;
    discs_.push_back({discs.centres[s], glm::normalize(discs.normals[s]), discs.radii[s],
                      static_cast<std::uint32_t>(s)});
  }
  if (discs_.empty()) return;
  std::size_t leaves = 1;
  while (leaves * kDiscsOfLeaf < discs_.size()) leaves *= 2;
  nodes_.resize(2 * leaves - 1);
  build(0, 0, static_cast<std::uint32_t>(discs_.size()));
}

void DiscTree::set_normals(const std::vector<glm::dvec3>& normals) {
  for (std::size_t slot = 0; slot < discs_.size(); ++slot) discs_[slot].normal = normals[slot];
}

void DiscTree::build(std::size_t node, std::uint32_t begin, std::uint32_t end) {
  Node made{glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity()), 0.0, begin, end};
  for (std::uint32_t d = begin; d < end; ++d) {
    made.low = glm::min(made.low, discs_[d].centre);
    made.high = glm::max(made.high, discs_[d].centre);
    made.max_radius = std::max(made.max_radius, discs_[d].radius);
  }
  nodes_[node] = made;
  if (is_leaf(node)) return;
  const glm::dvec3 size = made.high - made.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::uint32_t middle = begin + (end - begin) / 2;
  // Ties by the splat's number: the tree is the same for every sorting of the standard library.
  std::nth_element(discs_.begin() + begin, discs_.begin() + middle, discs_.begin() + end,
                   [axis](const Disc& a, const Disc& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                             : a.splat < b.splat;
                   });
  if (end - begin < kSubtreeOfOneThread) {
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
  } else {
    tbb::parallel_invoke([&] { build(2 * node + 1, begin, middle); },
                         [&] { build(2 * node + 2, middle, end); });
  }
}

bool DiscTree::neighbours(std::size_t slot, std::size_t most_tested,
                          std::vector<std::uint32_t>& slots) const {
  const Disc& self = discs_[slot];
  struct Waiting {
    std::size_t node;
    double squared;
  };
  // A child waits for each level above: 32 levels hold 2^32 leaves.
  std::array<Waiting, 64> waiting;  // NOLINT(cppcoreguidelines-pro-type-member-init): a stack
  std::size_t count = 0;
  const auto push = [&](std::size_t node) {
    const Node& pushed = nodes_[node];
    const double squared = squared_to_box(self.centre, pushed.low, pushed.high);
    const double reach = self.radius + pushed.max_radius;
    if (squared < reach * reach) waiting[count++] = {node, squared};
  };
  push(0);
  std::size_t tested = 0;
  while (count > 0) {
    const std::size_t node = waiting[--count].node;
    if (!is_leaf(node)) {
      const std::size_t before = count;
      push(2 * node + 1);
      push(2 * node + 2);
      // The nearer child is the next.
      if (count == before + 2 && waiting[before].squared < waiting[before + 1].squared)
        std::swap(waiting[before], waiting[before + 1]);
      continue;
    }
    for (std::uint32_t d = nodes_[node].begin; d < nodes_[node].end; ++d) {
      if (d == slot) continue;
      if (tested++ == most_tested) return false;
      const glm::dvec3 between = discs_[d].centre - self.centre;
      const double reach = self.radius + discs_[d].radius;
      if (glm::dot(between, between) < reach * reach) slots.push_back(d);
    }
  }
  return true;
}

}  // namespace relief
