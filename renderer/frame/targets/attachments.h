// What passes draw into: textures of an image's size, and the framebuffers that hold them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>

#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// A texture of one level that shaders read texel by texel. (With OpenGL's own filters integers are
/// no complete texture, and shaders read 0.)
[[nodiscard]] Texture make_attachment(const Gl& gl, const char* label, GLenum format,
                                      std::uint32_t width, std::uint32_t height);

/// What a shader writes at a location.
struct ColourAttachment {
  GLuint location;
  const Texture* texture;  ///< null: nothing, what is written there is dropped
};

/// A framebuffer with these attachments, which must outlive it. `z_buffer` null: depth is neither
/// tested nor kept.
[[nodiscard]] Framebuffer make_framebuffer(const Gl& gl, const char* label, const Texture* z_buffer,
                                           std::initializer_list<ColourAttachment> colours);

/// The texture, or null where there is none.
[[nodiscard]] inline const Texture* address(const std::optional<Texture>& texture) {
  return texture ? &*texture : nullptr;
}

}  // namespace relief
