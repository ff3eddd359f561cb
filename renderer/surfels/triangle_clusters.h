// Clusters of three points by recursive splits.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// A partition of points into small clusters, each one piece of `order`.
struct PointClusters {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> first;  ///< of each cluster, and the number of points as the last

  [[nodiscard]] std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cluster) const {
    return std::span(order).subspan(first[cluster], first[cluster + 1] - first[cluster]);
  }
};

/// Splits the points again and again by the plane through their centroid across the direction of
/// their greatest variation ([Textured surfels], section 3.3), until clusters have at most three
/// points. The plane is moved past at most two points, so that one side has a multiple of three:
/// all clusters but one have three points (docs/decisions/0128). Of n points the depth is at most
/// 64 + log2(n), wherever they are.
///
/// Positions are finite, at most 1 in size, and distinct. The result does not depend on the number
/// of threads. Fails only if it is interrupted.
Result<PointClusters> find_triangle_clusters(std::span<const glm::dvec3> positions,
                                             Progress& progress);

}  // namespace relief
