// Sorts positions so that those near each other in the list are near in space, and in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/bounds.h"

namespace relief {

/// Bits of a Morton code: 20 an axis.
inline constexpr unsigned kMortonBits = 60;

/// Returns a position's place along the Morton curve (Morton 1966) through the cube at the lower
/// corner of `box` that holds it. Positions outside count to the cube's sides. 0 in a box
/// whose sides overflow.
[[nodiscard]] std::uint64_t morton_code(glm::dvec3 position, const Bounds& box);

/// Returns the indices of codes in the order of the codes, equal ones in their own.
[[nodiscard]] std::vector<std::uint32_t> order_of(std::span<const std::uint64_t> codes);

/// Returns where each index is in an order of all.
[[nodiscard]] std::vector<std::uint32_t> places_in(std::span<const std::uint32_t> order);

}  // namespace relief
