// Normals that follow from a patch's heights alone (docs/patch-file.md, "NRML").
#pragma once

#include <cstdint>
#include <vector>

#include "common/patch.h"

namespace relief {

/// The normals of the heights at the samples, octahedral in the patch frame, in units of `step` of
/// their 16-bit coordinates; (0, 0) at holes. No product is followed by a sum, so that compilers
/// that fuse the two get the same.
[[nodiscard]] std::vector<glm::i16vec2> normals_of_heights(const Patch& patch, std::int32_t step);

}  // namespace relief
