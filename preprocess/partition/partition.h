// From points to regions that each become one patch (paper 001, section 3.1).
#pragma once

#include <vector>

#include "common/progress.h"
#include "preprocess/partition/region_criteria.h"

namespace relief {

/// Points that share a patch.
struct Region {
  std::vector<std::uint32_t> points;  ///< ascending
  glm::vec3 normal{0.0F};             ///< of the base plane, unit
};

/// What each point has to do with the region it belongs to.
struct Membership {
  std::vector<std::uint32_t> region;  ///< its index; the number of regions where it is in none
  std::vector<float> cosine;  ///< of the angle between the point's normal and the base-plane normal
                              ///< of its region; 1 where it is in none
};

[[nodiscard]] Membership membership_of(const SurfaceSamples& samples,
                                       const std::vector<Region>& regions);

/// Splits (Pauly and Gross 2001): cuts a point set through its centroid, across its direction of
/// greatest variance, again and again until each piece passes the test; pieces that are not
/// connected over the neighbour graph are parted.
[[nodiscard]] std::vector<Region> split(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                        std::vector<std::uint32_t> points,
                                        const RegionLimits& limits, Progress& progress);

/// Parts regions into the pieces that are connected over the neighbour graph.
[[nodiscard]] std::vector<Region> part_components(const SurfaceSamples& samples,
                                                  const NeighbourGraph& graph,
                                                  const std::vector<Region>& regions);

/// What may be merged.
struct MergeRule {
  RegionLimits limits;  ///< that the union must keep
  std::size_t small_points =
      static_cast<std::size_t>(-1);  ///< one of a pair must have fewer points
};

/// Merges neighbouring regions, best pair first (Ochotta and Saupe 2004), while the rule allows. A
/// pair is good if the union is flat, compact and small.
[[nodiscard]] std::vector<Region> merge(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                        std::vector<Region> regions, const MergeRule& rule,
                                        Progress& progress);

/// Split and merge; move borders and merge what that has made possible, twice; then merge under
/// wider limits what stayed small: spots where the scan is rough are no reason for a patch each.
/// Few, compact regions, largest first. Only `points` are partitioned.
/// `density_ratio`: as in RegionLimits.
[[nodiscard]] std::vector<Region> partition(const SurfaceSamples& samples,
                                            const NeighbourGraph& graph,
                                            std::vector<std::uint32_t> points, double cone_degrees,
                                            Progress& progress, double density_ratio = 0.0);

}  // namespace relief
