// A texture as a continuous function.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// c_c(s) = sum_i c_i n(s - s_i) of paper 000, section 5: a Gaussian of unit variance (in texels)
/// on each texel. It ends at four standard deviations and its weights are made to sum to 1, so that
/// a constant stays constant. The texture repeats outside [0, 1]^2.
class ContinuousTexture {
 public:
  /// From the channels R, G, B (linear). Values that are no numbers count as 0, others are
  /// clamped to what half precision holds. Fails with one sentence if a channel is missing or the
  /// picture is empty.
  static Result<ContinuousTexture> from_image(const Image& image);

  /// Linear RGB at (u, v), v upward; finite for finite (u, v). `deviation`: the Gaussian's, in
  /// texels, 1 to kLargestDeviation. More than 1 keeps a texture from aliasing that is finer than
  /// the places where it is asked for.
  [[nodiscard]] glm::vec3 at(glm::vec2 texcoord, double deviation = 1.0) const;

  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }

  /// Bounds the work of one evaluation: 65 x 65 texels.
  static constexpr double kLargestDeviation = 8.0;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<glm::vec3> texels_;  ///< row-major, top row first
};

}  // namespace relief
