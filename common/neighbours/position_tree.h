// The kd-tree over positions that the neighbour searches share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// A kd-tree that keeps the positions in the order of its leaves, so that the positions of a leaf
/// lie in one piece. A position's index in that order is its slot.
///
/// A node's box is split in the middle of its longest side. The tree, the order of the slots and
/// the order in which `visit_near` visits leaves depend on the positions and their order only.
/// Patch files depend on that order: it decides between neighbours at equal distances.
class PositionTree {
 public:
  /// Maximum number of positions in a leaf.
  static constexpr std::size_t kLeafSize = 16;

  /// A leaf, or a split whose lower side is the next node.
  struct Node {
    static constexpr std::uint32_t kLeaf = 3;
    double low = 0.0;            ///< split: the upper end of the lower side's positions
    double high = 0.0;           ///< split: the lower end of the upper side's positions
    std::uint32_t axis = kLeaf;  ///< of the split
    std::uint32_t first = 0;     ///< leaf: its first slot; split: the node of the upper side
    std::uint32_t count = 0;     ///< leaf: its slots
  };

  /// All positions are finite.
  explicit PositionTree(const std::vector<glm::dvec3>& positions);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }

  /// The index, in the vector that the tree was built from, of the position in a slot.
  [[nodiscard]] std::uint32_t index(std::size_t slot) const { return order_[slot]; }

  /// The position in a slot.
  [[nodiscard]] glm::dvec3 at(std::size_t slot) const { return {x_[slot], y_[slot], z_[slot]}; }

  /// Computes the squared distances of `from` to the positions in the slots from `first` on. Writes
  /// kLeafSize of them; those past the leaf's last slot are meaningless.
  void squared_distances(glm::dvec3 from, std::size_t first,
                         std::array<double, kLeafSize>& squared) const {
    const double* x = x_.data() + first;
    const double* y = y_.data() + first;
    const double* z = z_.data() + first;
    for (std::size_t m = 0; m < kLeafSize; ++m) {
      const double dx = from.x - x[m];
      const double dy = from.y - y[m];
      const double dz = from.z - z[m];
      squared[m] = dx * dx + dy * dy + dz * dz;
    }
  }

  /// Calls `visit_leaf(first, count)` for the leaves that may hold positions whose squared distance
  /// to `from` is at most `squared_reach()`, the nearer side of each split first. `squared_reach`
  /// may shrink during the search.
  template <class SquaredReach, class VisitLeaf>
  void visit_near(glm::dvec3 from, const SquaredReach& squared_reach,
                  const VisitLeaf& visit_leaf) const {
    if (nodes_.empty()) return;
    glm::dvec3 apart(0.0);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      if (from[axis] < lowest_[axis]) apart[axis] = from[axis] - lowest_[axis];
      if (from[axis] > highest_[axis]) apart[axis] = from[axis] - highest_[axis];
    }
    apart *= apart;
    const double squared = apart.x + apart.y + apart.z;
    if (squared > squared_reach()) return;
    Visit<SquaredReach, VisitLeaf>{nodes_.data(), from, apart, squared_reach, visit_leaf}.at(
        0, squared);
  }

 private:
  /// One call of visit_near.
  template <class SquaredReach, class VisitLeaf>
  struct Visit {
    const Node* nodes;
    glm::dvec3 from;
    glm::dvec3 by_axis;  ///< the parts of the squared distance to the node's box
    const SquaredReach& squared_reach;
    const VisitLeaf& visit_leaf;

    /// `squared` is the squared distance to the node's box.
    void at(std::uint32_t index, double squared) {
      const Node& node = nodes[index];
      if (node.axis == Node::kLeaf)
        return visit_leaf(std::size_t{node.first}, std::size_t{node.count});
      const auto axis = static_cast<glm::length_t>(node.axis);
      const double value = from[axis];
      const bool lower = (value - node.low) + (value - node.high) < 0.0;
      at(lower ? index + 1 : node.first, squared);
      const double beyond = value - (lower ? node.high : node.low);
      const double before = by_axis[axis];
      squared = squared + beyond * beyond - before;
      if (squared > squared_reach()) return;
      by_axis[axis] = beyond * beyond;
      at(lower ? node.first : index + 1, squared);
      by_axis[axis] = before;
    }
  };

  std::vector<Node> nodes_;           // a split, then its lower side's nodes, then its upper side's
  std::vector<std::uint32_t> order_;  // by slot
  std::vector<double> x_, y_, z_;     // by slot, and kLeafSize more to read past the last leaf
  glm::dvec3 lowest_{0.0}, highest_{0.0};  // the box of all positions
};

}  // namespace relief
