// The kd-tree over positions that the neighbour searches share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nanoflann.hpp>
#include <vector>

namespace relief {

/// What nanoflann asks of positions.
struct PositionsAdaptor {
  const std::vector<glm::dvec3>& positions;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return positions.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return positions[i][static_cast<glm::length_t>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

using PositionTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PositionsAdaptor>,
                                        PositionsAdaptor, 3, std::uint32_t>;

/// Positions in one leaf of the tree.
inline constexpr std::size_t kTreeLeafSize = 16;

}  // namespace relief
