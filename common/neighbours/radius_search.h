// Finds all points within a radius.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/neighbours/position_tree.h"

namespace relief {

/// Finds the positions within a radius. Keeps its own copy of the positions, which are finite.
class RadiusSearch {
 public:
  explicit RadiusSearch(const std::vector<glm::dvec3>& positions) : tree_(positions) {}

  /// Fills `found` with the indices of all positions nearer to `centre` than `radius` (world
  /// units), ascending. May be called from several threads at once.
  void find(glm::dvec3 centre, double radius, std::vector<std::uint32_t>& found) const {
    found.clear();
    any(centre, radius, [&found](std::uint32_t i) {
      found.push_back(i);
      return false;
    });
    std::sort(found.begin(), found.end());
  }

  /// Whether `is(index)` for any position nearer to `centre` than `radius`. Ends with the first
  /// one, in no stated order.
  template <class Is>
  bool any(glm::dvec3 centre, double radius, const Is& is) const {
    double squared_reach = radius * radius;
    bool is_any = false;
    const auto look_at_leaf = [&](std::size_t first, std::size_t count) {
      std::array<double, PositionTree::kLeafSize> squared;
      tree_.squared_distances(centre, first, squared);
      for (std::size_t m = 0; m < count && !is_any; ++m)
        is_any = squared[m] < squared_reach && is(tree_.index(first + m));
      if (is_any) squared_reach = -1.0;
    };
    tree_.visit_near(
        centre, [&squared_reach] { return squared_reach; }, look_at_leaf);
    return is_any;
  }

 private:
  PositionTree tree_;
};

}  // namespace relief
