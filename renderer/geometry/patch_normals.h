// The normals that every engine gives a patch.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/patch.h"

namespace relief {

/// The patch's own normal map, or if it has none one normal per node from the slopes of its
/// heights. Octahedral, in the patch frame.
[[nodiscard]] AttributeMap<glm::i16vec2> normal_map_of(const Patch& patch);

/// The unit normal of a node's own square, a cell large, of such a map: the mean of its texels
/// there, of a map with one texel a cell that one.
[[nodiscard]] glm::vec3 normal_at_node(const AttributeMap<glm::i16vec2>& map, std::uint32_t i,
                                       std::uint32_t j);

}  // namespace relief
