// How far the patches are from the points they came from.
#pragma once

#include <optional>
#include <vector>

#include "common/patch.h"
#include "preprocess/points/neighbours.h"

namespace relief {

/// Points farther than so many spacings from every patch are uncovered.
inline constexpr double kUncoveredInSpacings = 2.0;

/// The distance of a world point to a patch's bilinear surface along its normal (world units):
/// within a cell of four samples the bilinear height, in a cell of three the plane through them,
/// elsewhere the distance to the nearest sample within two cells. Nothing if there is none.
[[nodiscard]] std::optional<double> distance_to_patch(const Patch& patch, glm::dvec3 point);

struct Fidelity {
  double rms = 0.0;             ///< world units
  double max = 0.0;             ///< world units
  std::uint64_t uncovered = 0;  ///< points farther than two spacings from every patch
};

/// Measures the first `count` points against the patches of their neighbourhood; `owner` is each
/// point's patch (index into `patches`, or patches.size() if it has none). Points farther than two
/// spacings from those are tried against every patch; what no patch is near counts in `max` and
/// `rms` with the distance of two spacings, the least it can be.
[[nodiscard]] Fidelity measure_fidelity(const std::vector<glm::dvec3>& positions, std::size_t count,
                                        const NeighbourGraph& graph,
                                        const std::vector<std::uint32_t>& owner,
                                        const std::vector<Patch>& patches);

/// Which of the small patches (at most `small_points` own points) others cover: every own point
/// within one spacing of another patch that stays. `own_points` lists each patch's points.
[[nodiscard]] std::vector<std::uint8_t> find_redundant(
    const std::vector<glm::dvec3>& positions, const NeighbourGraph& graph,
    const std::vector<std::uint32_t>& owner,
    const std::vector<std::vector<std::uint32_t>>& own_points, const std::vector<Patch>& patches,
    std::size_t small_points);

}  // namespace relief
