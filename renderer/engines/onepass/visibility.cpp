#include "renderer/engines/onepass/visibility.h"

#include <array>
#include <utility>

#include "shaders/include/shared.h"

namespace relief::onepass {

Result<Visibility> make_visibility(const Gl& gl, const Targets& targets, const Texture& z_buffer,
                                   std::uint32_t features) {
  const auto make = [&](const char* label, GLenum format) {
    Texture texture(gl, label, GLenum{GL_TEXTURE_2D});
    gl.TextureStorage2D(texture.id(), 1, format, static_cast<GLsizei>(targets.width),
                        static_cast<GLsizei>(targets.height));
    return texture;
  };
  Visibility made{make("places", GL_RG32UI), std::nullopt, Framebuffer(gl, "visibility")};
  const GLuint id = made.framebuffer.id();
  std::array<GLenum, 2> draw{};  // GL_NONE
  const auto attach = [&](GLuint location, const Texture& texture) {
    draw[location] = GL_COLOR_ATTACHMENT0 + location;
    gl.NamedFramebufferTexture(id, draw[location], texture.id(), 0);
  };
  gl.NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, z_buffer.id(), 0);
  // With the default filters integers are no complete texture, and shaders read 0.
  gl.TextureParameteri(made.places.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TextureParameteri(made.places.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  attach(RELIEF_OUT_FOUND, made.places);
  if ((features & (RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS)) != 0) {
    made.depths = make("depths", GL_R32F);
    attach(RELIEF_OUT_FOUND_DEPTH, *made.depths);
  }
  gl.NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw.size()), draw.data());
  const Status checked = check_errors(gl, "the visibility buffer");
  if (!checked) return checked.error();
  return made;
}

bool can_be_found(const PatchStore& store) {
  return store.patches.size() <= std::size_t{1} << (2 * shared::kFoundPatchBits);
}

float place_steps(std::uint32_t side) {
  const float cells = static_cast<float>(side) + 2.0F * shared::kFoundBegin;
  float steps = 1.0F;
  while (2.0F * steps * cells <= static_cast<float>(shared::kFoundMask)) steps *= 2.0F;
  return steps;
}

}  // namespace relief::onepass
