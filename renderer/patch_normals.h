// The normals that a patch has where its file has none.
#pragma once

#include "common/patch.h"

namespace relief {

/// One normal per node, octahedral, from the slopes of the heights; over holes those of their
/// surroundings.
[[nodiscard]] AttributeMap<glm::i16vec2> normals_of_heights(const Patch& patch);

}  // namespace relief
