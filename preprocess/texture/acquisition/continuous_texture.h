// Textures as continuous functions.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// c_c(s) = sum_i c_i n(s - s_i) of [Zwicker 2001], section 5: a Gaussian of unit variance (in
/// texels) on each texel. The Gaussian ends at four standard deviations and its weights are scaled
/// to sum to 1, which preserves constants. The texture repeats outside [0, 1]^2.
class ContinuousTexture {
 public:
  /// Makes a texture of the channels R, G, B (linear). NaN becomes 0; other values are clamped to
  /// the range of half precision. Fails with one sentence if a channel is missing or the image is
  /// empty.
  static Result<ContinuousTexture> from_image(const Image& image);

  /// Returns linear RGB at (u, v), v upward; finite for finite (u, v). `deviation` of the Gaussian
  /// in texels, 1 to kLargestDeviation. Values above 1 prevent aliasing of a texture that is finer
  /// than the sampled positions.
  [[nodiscard]] glm::vec3 at(glm::vec2 texcoord, double deviation = 1.0) const;

  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }

  /// Limits one evaluation to 65 x 65 texels.
  static constexpr double kLargestDeviation = 8.0;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<glm::vec3> texels_;  ///< row-major, top row first
};

}  // namespace relief
