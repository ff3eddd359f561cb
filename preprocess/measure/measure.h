// Measures the distance of points to patches.
#pragma once

#include <optional>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/patch.h"
#include "common/seams/seam_distances.h"
#include "preprocess/measure/patch_distance.h"

namespace relief {

/// Points farther than this many spacings from every patch are uncovered.
inline constexpr double kUncoveredInSpacings = 2.0;

struct Fidelity {
  double rms = 0.0;             ///< world units
  double max = 0.0;             ///< world units
  std::uint64_t uncovered = 0;  ///< points farther than two spacings from every patch
};

/// Returns the distances of the first `count` points to the patches of their neighbourhood;
/// infinite if none is near. `owner` is each point's patch (index into `patches`, or patches.size()
/// if it has none).
[[nodiscard]] std::vector<double> distances_to_patches(const std::vector<glm::dvec3>& positions,
                                                       std::size_t count,
                                                       const NeighbourGraph& graph,
                                                       const std::vector<std::uint32_t>& owner,
                                                       const std::vector<Patch>& patches);

/// Lowers the distances of points that are nearer to the seams between patches that meet.
void compare_with_seams(const std::vector<glm::dvec3>& positions, const std::vector<Patch>& patches,
                        const SeamDistances& seams, std::vector<double>& distances);

/// Sums up distances that those functions returned. Points farther than two spacings are compared
/// with every patch. A point without a near patch counts in `max` and `rms` with two spacings, its
/// smallest possible distance.
[[nodiscard]] Fidelity measure_fidelity(const std::vector<glm::dvec3>& positions,
                                        const std::vector<double>& distances,
                                        const std::vector<Patch>& patches);

/// Returns which small patches (at most `small_points` own points) are covered by others: every own
/// point is within one spacing of another remaining patch. `own_points` lists each patch's points.
[[nodiscard]] std::vector<std::uint8_t> find_redundant(
    const std::vector<glm::dvec3>& positions, const NeighbourGraph& graph,
    const std::vector<std::uint32_t>& owner,
    const std::vector<std::vector<std::uint32_t>>& own_points, const std::vector<Patch>& patches,
    std::size_t small_points);

}  // namespace relief
