// What a textured mesh should look like: many samples a pixel, each the texture itself.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/camera.h"
#include "common/points.h"
#include "preprocess/texture/continuous_texture.h"

namespace relief::experiment {

/// A picture of linear light with the share of each pixel that the mesh covers.
struct Truth {
  std::vector<glm::dvec3> colours;  ///< row-major, top row first
  std::vector<double> coverage;
};

/// The low-pass filter that the samples go through: the Gaussian of unit variance in pixels that
/// EWA takes (section 3.3), or the mean over each pixel.
enum class PixelFilter : std::uint8_t { Gaussian, Box };

/// Rasterises the front of the mesh with 8 x 8 samples a pixel, evaluates the texture's continuous
/// function at each and filters.
[[nodiscard]] Truth render_truth(const Points& mesh, const ContinuousTexture& texture,
                                 const Camera& camera, std::uint32_t side, PixelFilter filter);

}  // namespace relief::experiment
