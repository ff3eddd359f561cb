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

}  // namespace relief::volume
