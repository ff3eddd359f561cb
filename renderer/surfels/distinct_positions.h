// Positions without duplicates, at a common scale.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace relief {

/// The finite positions of some points, each once, moved and scaled into the cube from -1 to 1, so
/// that squares and cubes of distances neither overflow nor vanish.
struct DistinctPositions {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<glm::dvec3> positions;  ///< in the order in which the points have them first
  std::vector<std::uint32_t> of;  ///< of each point, an index into `positions`; kNone: not finite
  double unit = 1.0;              ///< the cube's half side, world units; above 0
};

[[nodiscard]] DistinctPositions find_distinct_positions(std::span<const glm::dvec3> positions);

}  // namespace relief
