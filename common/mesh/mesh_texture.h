// Colour textures of meshes.
#pragma once

#include <glm/vec3.hpp>

#include "common/error.h"
#include "common/image/image.h"
#include "common/image/srgb.h"
#include "common/image/texture_pyramid.h"

namespace relief {

/// 8-bit sRGB colours, filtered as linear RGB.
struct SrgbTexelCodec {
  using Texel = glm::u8vec3;
  static glm::vec3 decode(Texel texel) { return linear_from_srgb8(texel); }
  static Texel encode(glm::vec3 light) { return srgb8_from_linear(light); }
};

/// A texture of 8-bit sRGB colours with its mip levels, each the mean, in linear light, of the
/// level before. Filtering in linear light keeps a constant colour unchanged.
class MeshTexture : public TexturePyramid<SrgbTexelCodec> {
 public:
  using TexturePyramid::TexturePyramid;

  /// Makes a texture of the channels R, G, B (linear, premultiplied if there is an A), clamped to
  /// [0, 1]; NaN becomes 0. Opacity is ignored: a fully transparent pixel gets the mean of the
  /// others. Fails, with a clause, if a channel is missing or all pixels are transparent.
  static Result<MeshTexture> from_image(const Image& image, TextureWrap wrap);
};

}  // namespace relief
