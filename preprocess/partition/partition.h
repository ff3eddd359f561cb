// Partitions points into regions, one a patch ([Ochotta 2008], section 3.1).
#pragma once

#include <vector>

#include "common/progress.h"
#include "preprocess/partition/region.h"
#include "preprocess/partition/region_criteria.h"

namespace relief {

[[nodiscard]] Membership membership_of(const SurfaceSamples& samples,
                                       const std::vector<Region>& regions);

/// Splits (Pauly and Gross 2001): cuts a point set through its centroid, across its direction of
/// greatest variance, recursively until each piece passes the test. Separates pieces that are not
/// connected in the neighbour graph.
[[nodiscard]] std::vector<Region> split(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                        std::vector<std::uint32_t> points,
                                        const RegionLimits& limits, Progress& progress);

/// Splits regions into components that are connected in the neighbour graph.
[[nodiscard]] std::vector<Region> part_components(const SurfaceSamples& samples,
                                                  const NeighbourGraph& graph,
                                                  const std::vector<Region>& regions);

/// The condition for merging.
struct MergeRule {
  RegionLimits limits;  ///< limits of the union
  std::size_t small_points =
      static_cast<std::size_t>(-1);  ///< one of a pair must have fewer points
  /// For each point, whether it is at a crease, or null: regions whose border is a crease for the
  /// most part stay apart.
  const std::vector<std::uint8_t>* at_crease = nullptr;
};

/// Merges neighbouring regions, best pair first (Ochotta and Saupe 2004), while the rule allows it.
/// Good pairs have a flat, compact and small union.
[[nodiscard]] std::vector<Region> merge(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                        std::vector<Region> regions, const MergeRule& rule,
                                        Progress& progress);

/// Partitions `points` into few, compact regions, largest first. Splits and merges; moves borders
/// and merges again, twice; then merges the remaining small regions under wider limits, because
/// rough spots of the scan do not deserve a patch each. `at_crease`: as in MergeRule.
[[nodiscard]] std::vector<Region> partition(const SurfaceSamples& samples,
                                            const NeighbourGraph& graph,
                                            std::vector<std::uint32_t> points, double cone_degrees,
                                            const std::vector<std::uint8_t>* at_crease,
                                            Progress& progress);

}  // namespace relief
