// The nearest neighbours of many positions, one after another.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/neighbours/position_tree.h"

namespace relief {

/// Finds the k nearest other positions of a position in a tree, exactly. Of positions at equal
/// distances it takes and returns first those in the leaf that the tree visits first, and in a leaf
/// those with the lower slot.
///
/// One search bounds the next: a search is fastest from a position near that of the search before.
class NearestSearch {
 public:
  /// `k` is below the number of positions.
  NearestSearch(const PositionTree& tree, std::uint32_t k) : tree_(tree), squared_(k), slots_(k) {}

  /// Searches from the position in a slot.
  void find(std::uint32_t slot);

  /// The slot of the m-th nearest position, from 0, and its squared distance.
  [[nodiscard]] std::uint32_t slot(std::size_t m) const { return slots_[m]; }
  [[nodiscard]] double squared(std::size_t m) const { return squared_[m]; }

 private:
  void look_at_leaf(std::size_t first, std::size_t count);
  [[nodiscard]] double farthest_bound(glm::dvec3 from) const;

  const PositionTree& tree_;
  std::vector<double> squared_;  // ascending
  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
  std::uint32_t self_ = 0;
  glm::dvec3 from_{0.0};
  // Only positions nearer than this are neighbours.
  double farthest_ = std::numeric_limits<double>::infinity();
};

}  // namespace relief
