#include "common/neighbours/nearest_search.h"

#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {

// The position of the search before has k others and itself within its own farthest distance.
double NearestSearch::farthest_bound(glm::dvec3 from) const {
  if (count_ == 0) return std::numeric_limits<double>::infinity();
  const double reach = std::sqrt(squared_[count_ - 1]) + glm::distance(from, from_);
  // More than rounding, and more than 0.
  return reach * reach * 1.000001 + std::numeric_limits<double>::min();
}

void NearestSearch::find(std::uint32_t slot) {
  const glm::dvec3 from = tree_.at(slot);
  farthest_ = farthest_bound(from);
  from_ = from;
  self_ = slot;
  count_ = 0;
  tree_.visit_near(
      from, [this] { return farthest_; },
      [this](std::size_t first, std::size_t count) { look_at_leaf(first, count); });
  assert(count_ == squared_.size() && "there are more than k positions");
}

void NearestSearch::look_at_leaf(std::size_t first, std::size_t count) {
  std::array<double, PositionTree::kLeafSize> squared;
  tree_.squared_distances(from_, first, squared);
  // Which of a leaf's positions are near is hard to predict, so they are collected without a
  // branch.
  std::array<std::uint32_t, PositionTree::kLeafSize> near;
  std::size_t near_count = 0;
  for (std::size_t m = 0; m < count; ++m) {
    near[near_count] = static_cast<std::uint32_t>(m);
    near_count += squared[m] < farthest_ ? 1 : 0;
  }
  for (std::size_t n = 0; n < near_count; ++n) {
    const std::size_t m = near[n];
    if (!(squared[m] < farthest_) || first + m == self_) continue;
    if (count_ < squared_.size()) ++count_;
    std::size_t at = count_ - 1;
    for (; at > 0 && squared_[at - 1] > squared[m]; --at) {
      squared_[at] = squared_[at - 1];
      slots_[at] = slots_[at - 1];
    }
    squared_[at] = squared[m];
    slots_[at] = static_cast<std::uint32_t>(first + m);
    if (count_ == squared_.size()) farthest_ = squared_[count_ - 1];
  }
}

}  // namespace relief
