// Makes textures that materials share of decoded images.
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

/// Returns the image as a `Texture` (MeshTexture, NormalTexture). Fails with the error of reading
/// the image, or with one sentence that begins with `name`, the image's name. `what` is the
/// texture's description in messages.
template <class Texture>
Result<std::shared_ptr<const Texture>> decode_texture(const std::string& name,
                                                      const Result<Image>& image, TextureWrap wrap,
                                                      std::string_view what) {
  if (!image) return image.error();
  const std::string task = fmt::format("hold the {}", what);
  const GuardedCall holding{.subject = name,
                            .task = task,
                            .advice = kReportDefect,
                            .memory_advice = "free some memory, or use a smaller image"};
  return guarded(holding, [&]() -> Result<std::shared_ptr<const Texture>> {
    auto texture = Texture::from_image(*image, wrap);
    if (!texture) return make_error("{}: {}", name, texture.error().message);
    return std::make_shared<const Texture>(std::move(*texture));
  });
}

/// Returns how a texture continues outside [0, 1]^2, given whether the mesh file clamps it.
[[nodiscard]] inline TextureWrap wrap_of(bool clamps) {
  return clamps ? TextureWrap::Clamp : TextureWrap::Repeat;
}

}  // namespace relief
