// The tilt of every splat of a patch.
#pragma once

#include <glm/ext/vector_int2_sized.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "common/patch.h"
#include "renderer/geometry/samples/padded_heights.h"

namespace relief {

/// Slopes as signed bytes, in steps that the steepest of the patch fills.
struct SplatSlopes {
  std::vector<glm::i8vec2> steps;  ///< by padded index
  float slope_step = 0.0F;         ///< height in cells per cell, per step

  [[nodiscard]] glm::vec2 at(std::size_t k) const { return slope_step * glm::vec2(steps[k]); }
};

/// A splat's plane has the slope of the heights (central differences), not that of the normal map:
/// the planes must meet, whatever is painted on them, and an unlit image needs no normals. At
/// borders normals are no better than one-sided differences (docs/decisions/0151).
/// `height_step`: cells per height index.
[[nodiscard]] SplatSlopes find_slopes(const PaddedHeights& heights, const Patch& patch,
                                      float height_step);

}  // namespace relief
