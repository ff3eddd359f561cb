#include "common/neighbours/radius_search.h"

#include <algorithm>
#include <array>

#include "common/neighbours/position_tree.h"

namespace relief {

RadiusSearch::RadiusSearch(const std::vector<glm::dvec3>& positions)
    : tree_(std::make_unique<const PositionTree>(positions)) {}

RadiusSearch::~RadiusSearch() = default;

void RadiusSearch::find(glm::dvec3 centre, double radius, std::vector<std::uint32_t>& found) const {
  found.clear();
  const double squared_radius = radius * radius;
  const auto look_at_leaf = [&](std::size_t first, std::size_t count) {
    std::array<double, PositionTree::kLeafSize> squared;
    tree_->squared_distances(centre, first, squared);
    for (std::size_t m = 0; m < count; ++m) {
      if (squared[m] < squared_radius) found.push_back(tree_->index(first + m));
    }
  };
  tree_->visit_near(
      centre, [squared_radius] { return squared_radius; }, look_at_leaf);
  std::sort(found.begin(), found.end());
}

}  // namespace relief
