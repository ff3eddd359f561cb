// The normals that every engine gives a patch.
#pragma once

#include <glm/vec2.hpp>

#include "common/patch.h"

namespace relief {

/// The patch's own normal map, or if it has none one normal per node from the slopes of its
/// heights. Octahedral, in the patch frame.
[[nodiscard]] AttributeMap<glm::i16vec2> normal_map_of(const Patch& patch);

}  // namespace relief
