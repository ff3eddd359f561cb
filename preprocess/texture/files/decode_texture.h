// From a decoded picture to a texture that materials share.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "common/error.h"
#include "common/guard.h"
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
  const std::string task = fmt::format("hold the {}", what);
  return guarded({.subject = name, .task = task}, [&]() -> Result<std::shared_ptr<const Texture>> {
    auto texture = Texture::from_image(*image, wrap);
    if (!texture) return make_error("{}: {}", name, texture.error().message);
    return std::make_shared<const Texture>(std::move(*texture));
  });
}

/// How a texture goes on outside [0, 1]^2 that a mesh file says is clamped, or is not.
[[nodiscard]] inline TextureWrap wrap_of(bool clamps) {
  return clamps ? TextureWrap::Clamp : TextureWrap::Repeat;
}

}  // namespace relief
