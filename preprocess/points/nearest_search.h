// The nearest neighbours of many positions, one after another.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "preprocess/points/position_tree.h"

namespace relief {

/// A tree's positions in the order of its leaves, so that a leaf's are read and compared together.
class LeafPositions {
 public:
  LeafPositions(const PositionTree& tree, const std::vector<glm::dvec3>& positions);

  [[nodiscard]] glm::dvec3 at(std::size_t place) const { return {x_[place], y_[place], z_[place]}; }

  /// The squared distances of the positions from `first` on, as many as a leaf may have; beyond the
  /// last one they mean nothing.
  void squared_distances(glm::dvec3 from, std::size_t first,
                         std::array<double, kTreeLeafSize>& squared) const;

 private:
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> z_;
};

/// Finds the k nearest others of a position: what nanoflann's knnSearch finds, in the same order
/// where distances are equal, in three quarters of the time (Dragon). The search before, of a
/// position that is near, tells how far the farthest can be at most.
class NearestSearch {
 public:
  /// `k` below the number of positions.
  NearestSearch(const PositionTree& tree, const LeafPositions& positions, std::uint32_t k)
      : tree_(tree), positions_(positions), squared_(k), places_(k) {}

  /// Searches from the position at a place in the leaves' order.
  void find(std::uint32_t place);

  /// The place of the m-th nearest, in the leaves' order, and its squared distance.
  [[nodiscard]] std::uint32_t place(std::size_t m) const { return places_[m]; }
  [[nodiscard]] double squared(std::size_t m) const { return squared_[m]; }

 private:
  void visit(const PositionTree::Node& node, double least);
  void look_at_leaf(const PositionTree::Node& leaf);
  [[nodiscard]] double farthest_bound(glm::dvec3 from) const;

  const PositionTree& tree_;
  const LeafPositions& positions_;
  std::vector<double> squared_;  // ascending
  std::vector<std::uint32_t> places_;
  std::size_t count_ = 0;
  std::uint32_t self_ = 0;
  glm::dvec3 from_{0.0};
  glm::dvec3 to_node_{0.0};  // squared distances to the node that is visited, by axis
  // What is not nearer than this is not wanted.
  double farthest_ = std::numeric_limits<double>::infinity();
};

}  // namespace relief
