#include "preprocess/points/radius_search.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "preprocess/points/position_tree.h"

namespace relief {
namespace {

/// Receives nanoflann's results without the distances.
class IndicesWithin {
 public:
  IndicesWithin(double squared_radius, std::vector<std::uint32_t>& found)
      : squared_radius_(squared_radius), found_(found) {}

  // The names that nanoflann calls.
  [[nodiscard]] bool full() const { return true; }  // NOLINT
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] double worstDist() const { return squared_radius_; }  // NOLINT
  bool addPoint(double squared_distance, std::uint32_t index) {       // NOLINT
    if (squared_distance < squared_radius_) found_.push_back(index);
    return true;
  }

 private:
  double squared_radius_;
  std::vector<std::uint32_t>& found_;
};

}  // namespace

struct RadiusSearch::Tree {
  explicit Tree(const std::vector<glm::dvec3>& positions)
      : adaptor{positions},
        tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(kTreeLeafSize)) {}

  PositionsAdaptor adaptor;
  PositionTree tree;
};

RadiusSearch::RadiusSearch(const std::vector<glm::dvec3>& positions)
    : tree_(std::make_unique<const Tree>(positions)) {}

RadiusSearch::~RadiusSearch() = default;

void RadiusSearch::find(glm::dvec3 centre, double radius, std::vector<std::uint32_t>& found) const {
  found.clear();
  IndicesWithin within(radius * radius, found);
  tree_->tree.findNeighbors(within, &centre.x, nanoflann::SearchParams());
  std::sort(found.begin(), found.end());
}

}  // namespace relief
