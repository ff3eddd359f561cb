// The colours of a surface as a picture that texture coordinates refer to.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image.h"
#include "common/srgb.h"
#include "common/texture_pyramid.h"

namespace relief {

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

  /// Linear RGB, as TexturePyramid::at.
  [[nodiscard]] glm::vec3 at(glm::vec2 texcoord) const { return levels_.at(texcoord); }

  /// Linear RGB, as TexturePyramid::mean.
  [[nodiscard]] glm::vec3 mean(glm::vec2 texcoord, glm::vec2 du, glm::vec2 dv) const {
    return levels_.mean(texcoord, du, dv);
  }

  [[nodiscard]] std::uint32_t width() const { return levels_.width(); }
  [[nodiscard]] std::uint32_t height() const { return levels_.height(); }

 private:
  struct Codec {
    using Texel = glm::u8vec3;
    static glm::vec3 decode(Texel texel) { return linear_from_srgb8(texel); }
    static Texel encode(glm::vec3 light) { return srgb8_from_linear(light); }
  };

  TexturePyramid<Codec> levels_;
};

}  // namespace relief
