// The small relief of a surface as a picture of normals that texture coordinates refer to.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image.h"
#include "common/texture_pyramid.h"

namespace relief {

/// A texture of unit vectors with its mip levels, each the mean vector of the one before, which is
/// shorter where they spread. Relative to a surface (common/mesh_tangents.h) or to a patch.
class NormalTexture {
 public:
  /// Unit vectors times 32767 in row-major order, top row first. `width` and `height` above 0.
  NormalTexture(std::uint32_t width, std::uint32_t height, std::vector<glm::i16vec3> texels,
                TextureWrap wrap);

  /// Of a tangent-space normal map, with the channels R, G, B as its file stores them
  /// (Transfer::None), premultiplied where there is an A: (x, y, z) are twice them less 1, x along
  /// u and y along v, upward (glTF 2.0, section 3.9.3; OpenGL's convention). z is not below 0, and
  /// what has no direction or is wholly transparent is (0, 0, 1). Fails, with a clause, if a
  /// channel is missing or there are no pixels.
  static Result<NormalTexture> from_image(const Image& image, TextureWrap wrap);

  /// A vector of length 1 or less, as TexturePyramid::at.
  [[nodiscard]] glm::vec3 at(glm::vec2 texcoord) const { return levels_.at(texcoord); }

  /// The same, as TexturePyramid::mean.
  [[nodiscard]] glm::vec3 mean(glm::vec2 texcoord, glm::vec2 du, glm::vec2 dv) const {
    return levels_.mean(texcoord, du, dv);
  }

  [[nodiscard]] std::uint32_t width() const { return levels_.width(); }
  [[nodiscard]] std::uint32_t height() const { return levels_.height(); }

  /// A vector of length 1 or less as a texel. (8 bits, of which many normal maps are made, would
  /// add their rounding of a quarter of a degree at each level.)
  [[nodiscard]] static glm::i16vec3 texel_of(glm::vec3 v) {
    return glm::i16vec3(glm::round(32767.0F * v));
  }

 private:
  struct Codec {
    using Texel = glm::i16vec3;
    static glm::vec3 decode(Texel texel) { return glm::vec3(texel) / 32767.0F; }
    static Texel encode(glm::vec3 v) { return texel_of(v); }
  };

  TexturePyramid<Codec> levels_;
};

}  // namespace relief
