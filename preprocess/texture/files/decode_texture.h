// From a decoded picture to a texture that materials share.
#pragma once

#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/image/image.h"
#include "common/image/texture_pyramid.h"

namespace relief {

/// The picture as a `Texture` (MeshTexture, NormalTexture). Fails with one sentence that begins
/// with `name`, the picture's, or with what reading it said; `what` is what messages call the
/// texture.
template <class Texture>
Result<std::shared_ptr<const Texture>> decode_texture(const std::string& name,
                                                      const Result<Image>& image, TextureWrap wrap,
                                                      std::string_view what) {
  if (!image) return image.error();
  try {
    auto texture = Texture::from_image(*image, wrap);
    if (!texture) return make_error("{}: {}", name, texture.error().message);
    return std::make_shared<const Texture>(std::move(*texture));
  } catch (const std::bad_alloc&) {
    return make_error("{}: the {} does not fit into memory", name, what);
  }
}

/// How a texture goes on outside [0, 1]^2 that a mesh file says is clamped, or is not.
[[nodiscard]] inline TextureWrap wrap_of(bool clamps) {
  return clamps ? TextureWrap::Clamp : TextureWrap::Repeat;
}

}  // namespace relief
