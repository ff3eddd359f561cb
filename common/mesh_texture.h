// The colours of a surface as a picture that texture coordinates refer to.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image.h"

namespace relief {

/// What a texture shows outside [0, 1]^2.
enum class TextureWrap : std::uint8_t { Repeat, Clamp };

/// A texture of 8-bit sRGB colours with its mip levels, each the mean in linear light of the one
/// before. Filtering is in linear light, so that a constant colour stays what it is.
class MeshTexture {
 public:
  /// Colours of one size in row-major order, top row first. `width` and `height` above 0.
  MeshTexture(std::uint32_t width, std::uint32_t height, std::vector<glm::u8vec3> texels,
              TextureWrap wrap);

  /// From the channels R, G, B (linear, premultiplied where there is an A), clamped to [0, 1]; what
  /// is no number is 0. Opacity is left out: a wholly transparent pixel has the mean of the others.
  /// Fails, with a clause, if a channel is missing, or if all is transparent.
  static Result<MeshTexture> from_image(const Image& image, TextureWrap wrap);

  /// Linear RGB at (u, v), v upward: bilinear at the finest level. Finite for all finite (u, v).
  [[nodiscard]] glm::vec3 at(glm::vec2 texcoord) const;

  /// The mean over the parallelogram about (u, v) that `du` and `dv` span (texture coordinates):
  /// trilinear at the level of its shorter side, at as many places along its longer one as that is
  /// longer, 16 at most (McCormack et al. 1999, "Feline").
  [[nodiscard]] glm::vec3 mean(glm::vec2 texcoord, glm::vec2 du, glm::vec2 dv) const;

  [[nodiscard]] std::uint32_t width() const { return levels_.front().width; }
  [[nodiscard]] std::uint32_t height() const { return levels_.front().height; }

 private:
  struct Level {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<glm::u8vec3> texels;
  };
  [[nodiscard]] static Level halve(const Level& finer);
  [[nodiscard]] glm::vec3 bilinear(const Level& level, glm::vec2 texcoord) const;
  [[nodiscard]] glm::vec3 trilinear(glm::vec2 texcoord, float level) const;

  std::vector<Level> levels_;  ///< finest first; the last is one texel
  TextureWrap wrap_ = TextureWrap::Repeat;
};

}  // namespace relief
