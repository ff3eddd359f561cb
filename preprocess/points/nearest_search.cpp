#include "preprocess/points/nearest_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {

LeafPositions::LeafPositions(const PositionTree& tree, const std::vector<glm::dvec3>& positions) {
  for (std::vector<double>* axis : {&x_, &y_, &z_}) axis->resize(positions.size() + kTreeLeafSize);
  for (std::size_t place = 0; place < positions.size(); ++place) {
    const glm::dvec3 p = positions[tree.vAcc[place]];
    x_[place] = p.x;
    y_[place] = p.y;
    z_[place] = p.z;
  }
}

void LeafPositions::squared_distances(glm::dvec3 from, std::size_t first,
                                      std::array<double, kTreeLeafSize>& squared) const {
  const double* x = x_.data() + first;
  const double* y = y_.data() + first;
  const double* z = z_.data() + first;
  for (std::size_t m = 0; m < kTreeLeafSize; ++m) {
    const double dx = from.x - x[m];
    const double dy = from.y - y[m];
    const double dz = from.z - z[m];
    squared[m] = dx * dx + dy * dy + dz * dz;
  }
}

// Whoever stood at the place before has k others and itself within its own farthest.
double NearestSearch::farthest_bound(glm::dvec3 from) const {
  if (count_ == 0) return std::numeric_limits<double>::infinity();
  const double reach = std::sqrt(squared_[count_ - 1]) + glm::distance(from, from_);
  // More than rounding, and more than 0.
  return reach * reach * 1.000001 + std::numeric_limits<double>::min();
}

void NearestSearch::find(std::uint32_t place) {
  const glm::dvec3 from = positions_.at(place);
  farthest_ = farthest_bound(from);
  from_ = from;
  self_ = place;
  count_ = 0;
  to_node_ = glm::dvec3(0.0);  // the tree's box has the position in it
  visit(*tree_.root_node, 0.0);
  assert(count_ == squared_.size() && "there are more than k positions");
}

void NearestSearch::look_at_leaf(const PositionTree::Node& leaf) {
  const std::size_t first = leaf.node_type.lr.left;
  const std::size_t count = leaf.node_type.lr.right - first;
  std::array<double, kTreeLeafSize> squared;
  positions_.squared_distances(from_, first, squared);
  for (std::size_t m = 0; m < count; ++m) {
    if (!(squared[m] < farthest_) || first + m == self_) continue;
    if (count_ < squared_.size()) ++count_;
    std::size_t at = count_ - 1;
    for (; at > 0 && squared_[at - 1] > squared[m]; --at) {
      squared_[at] = squared_[at - 1];
      places_[at] = places_[at - 1];
    }
    squared_[at] = squared[m];
    places_[at] = static_cast<std::uint32_t>(first + m);
    if (count_ == squared_.size()) farthest_ = squared_[count_ - 1];
  }
}

// `least` is the squared distance to the node.
void NearestSearch::visit(const PositionTree::Node& node, double least) {
  if (node.child1 == nullptr) return look_at_leaf(node);
  const auto& cut = node.node_type.sub;
  double& along = to_node_[cut.divfeat];
  const double value = from_[cut.divfeat];
  const bool lower = (value - cut.divlow) + (value - cut.divhigh) < 0.0;
  visit(lower ? *node.child1 : *node.child2, least);
  const double beyond = value - (lower ? cut.divhigh : cut.divlow);
  const double before = along;
  least = least + beyond * beyond - before;
  if (least > farthest_) return;
  along = beyond * beyond;
  visit(lower ? *node.child2 : *node.child1, least);
  along = before;
}

}  // namespace relief
