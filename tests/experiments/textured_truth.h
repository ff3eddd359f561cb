// What a textured mesh should look like: many samples a pixel, each the texture itself.
#pragma once

#include <cstdint>

#include "common/points.h"
#include "common/scene/camera.h"
#include "preprocess/texture/acquisition/continuous_texture.h"
#include "tests/experiments/pixel_filter.h"

namespace relief::experiment {

/// Rasterises the front of the mesh with 8 x 8 samples a pixel, evaluates the texture's continuous
/// function at each and filters. What lies beside the image counts as not covered.
[[nodiscard]] Truths render_truth(const Points& mesh, const ContinuousTexture& texture,
                                  const Camera& camera, std::uint32_t side);

}  // namespace relief::experiment
