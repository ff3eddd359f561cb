// Normals derived from a patch's heights (docs/patch-file.md, "NRML").
#pragma once

#include <cstdint>
#include <vector>

#include "common/patch.h"

namespace relief {

/// Returns the normals derived from the heights at the samples, octahedral in the patch frame, in
/// units of `step` of their 16-bit coordinates; (0, 0) at holes. No sum follows a product, so that
/// compilers that fuse the two compute equal results.
[[nodiscard]] std::vector<glm::i16vec2> normals_of_heights(const Patch& patch, std::int32_t step);

}  // namespace relief
