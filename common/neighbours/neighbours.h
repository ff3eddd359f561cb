// The one neighbour search that every stage shares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Neighbours per point that surfaces are found from: 8 for the density, 16 for planes through
/// noise.
inline constexpr std::uint32_t kSurfaceNeighbours = 16;
/// Scans with fewer points have no useful neighbourhoods.
inline constexpr std::size_t kMinSurfacePoints = 16;

/// The k nearest neighbours of every point, and the local spacing that follows from them.
struct NeighbourGraph {
  std::uint32_t k = 0;
  std::vector<std::uint32_t> indices;  ///< k per point, nearest first, without the point itself
  /// Local spacing of the scan at each point, world units: the side of the square that holds one
  /// point on average, sqrt(pi r^2 / 8) with r the distance to the 8th neighbour; half its own,
  /// half the mean of its neighbours'.
  std::vector<float> spacing;

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t point) const {
    return {indices.data() + point * k, k};
  }
};

/// Finds min(k, n - 1) nearest neighbours of all n points (kd-tree, exact, in parallel).
/// `NearestSearch` says which neighbours win at equal distances.
/// The result does not depend on the number of threads.
[[nodiscard]] NeighbourGraph find_neighbours(const std::vector<glm::dvec3>& positions,
                                             std::uint32_t k);

/// Returns the neighbours of the points that are left when those with `dropped` are; `positions`:
/// of the points left, in the same order. `graph` is of all. Only points that had a dropped
/// neighbour are searched for again. The others keep their neighbours' order, equal distances
/// included.
[[nodiscard]] NeighbourGraph neighbours_after_drop(const NeighbourGraph& graph,
                                                   const std::vector<std::uint8_t>& dropped,
                                                   const std::vector<glm::dvec3>& positions);

/// Returns the neighbours of points that were put in another order; `order`: for each which one it
/// was.
[[nodiscard]] NeighbourGraph reordered(const NeighbourGraph& graph,
                                       std::span<const std::uint32_t> order);

/// Returns each point's distance to its eighth neighbour, or to its last if it has fewer, world
/// units. Every point has one.
[[nodiscard]] std::vector<float> distances_to_eighth(const std::vector<glm::dvec3>& positions,
                                                     const NeighbourGraph& graph);

}  // namespace relief
