// Normal maps of meshes and patches.
#pragma once

#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/vec3.hpp>

#include "common/error.h"
#include "common/image/image.h"
#include "common/image/texture_pyramid.h"

namespace relief {

/// Vectors of length 1 or less, times 32767. (8 bits, the depth of many normal maps, would add a
/// rounding of a quarter of a degree at each level.)
struct NormalTexelCodec {
  using Texel = glm::i16vec3;
  static glm::vec3 decode(Texel texel) { return glm::vec3(texel) / 32767.0F; }
  static Texel encode(glm::vec3 v) { return Texel(glm::round(32767.0F * v)); }
};

/// A texture of unit vectors with its mip levels. A level holds the mean vectors of the level
/// before, which are shorter where directions spread. Relative to a surface (mesh_tangents.h) or to
/// a patch.
class NormalTexture : public TexturePyramid<NormalTexelCodec> {
 public:
  using TexturePyramid::TexturePyramid;

  /// Makes a texture of a tangent-space normal map, whose channels R, G, B are as its file stores
  /// them (Transfer::None), premultiplied if there is an A. (x, y, z) are twice the channels minus
  /// 1, x along u and y along v, upward (glTF 2.0, section 3.9.3; OpenGL's convention). z is
  /// clamped to 0 or more; vectors without a direction and fully transparent pixels become (0, 0,
  /// 1). Fails, with a clause, if a channel is missing or there are no pixels.
  static Result<NormalTexture> from_image(const Image& image, TextureWrap wrap);

  /// Returns a vector of length 1 or less as a texel.
  [[nodiscard]] static Texel texel_of(glm::vec3 v) { return NormalTexelCodec::encode(v); }
};

}  // namespace relief
