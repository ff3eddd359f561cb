// How far empty space reaches in a grid.
#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace relief::volume {

/// For each block of kVolumeBlock nodes a side (x fastest): how many blocks away, along the axis
/// where that is most, the nearest one is that has a texel with w above 0; 255 at most.
[[nodiscard]] std::vector<std::uint8_t> block_distances(std::span<const glm::u16vec4> texels,
                                                        glm::uvec3 size);

/// The same in each sheet by itself: for each square of kVolumeSheetBlock nodes a side (u fastest,
/// then v, then the sheet), how many squares of its sheet away the nearest one is;
/// kMostSheetDistance at most. `axes`: which of x, y, z are u, v and across the sheets.
[[nodiscard]] std::vector<std::uint8_t> sheet_distances(std::span<const glm::u16vec4> texels,
                                                        glm::uvec3 size, glm::uvec3 axes);

inline constexpr std::uint8_t kMostSheetDistance = 8;

}  // namespace relief::volume
