#include "renderer/engines/onepass/layers.h"

#include <utility>
#include <vector>

#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

Texture make_texture(const Gl& gl, const char* label, GLenum format, const Targets& targets) {
  Texture texture(gl, label, GLenum{GL_TEXTURE_2D});
  gl.TextureStorage2D(texture.id(), 1, format, static_cast<GLsizei>(targets.width),
                      static_cast<GLsizei>(targets.height));
  return texture;
}

/// `outputs`: by location, null where there is none.
Framebuffer make_framebuffer(const Gl& gl, const char* label, const Texture* z_buffer,
                             const std::vector<const Texture*>& outputs) {
  Framebuffer framebuffer(gl, label);
  const GLuint id = framebuffer.id();
  if (z_buffer != nullptr) gl.NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, z_buffer->id(), 0);
  std::vector<GLenum> draw;
  for (const Texture* output : outputs) {
    const auto location = static_cast<GLenum>(draw.size());
    draw.push_back(output != nullptr ? GL_COLOR_ATTACHMENT0 + location : GLenum{GL_NONE});
    if (output != nullptr) gl.NamedFramebufferTexture(id, draw.back(), output->id(), 0);
  }
  gl.NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw.size()), draw.data());
  return framebuffer;
}

Result<Layer> make_layer(const Gl& gl, const Targets& targets, const Texture& colour,
                         std::uint32_t features) {
  Texture z_buffer = make_texture(gl, "layer depth", GL_DEPTH_COMPONENT32F, targets);
  Result<Visibility> visibility = make_visibility(gl, targets, z_buffer, features);
  if (!visibility) return visibility.error();
  Framebuffer shading = make_framebuffer(gl, "layer", &z_buffer, {&colour});
  return Layer{std::move(z_buffer), std::move(*visibility), std::move(shading)};
}

}  // namespace

Result<Layers> make_layers(const Gl& gl, const Targets& targets, std::uint32_t features) {
  const auto address = [](const std::optional<Texture>& texture) {
    return texture ? &*texture : nullptr;
  };
  Texture colour = make_texture(gl, "layers", GL_RGBA16F, targets);
  Result<Layer> one = make_layer(gl, targets, colour, features);
  if (!one) return one.error();
  Result<Layer> other = make_layer(gl, targets, colour, features);
  if (!other) return other.error();
  static_assert(RELIEF_OUT_COLOUR == 0 && RELIEF_OUT_NORMAL == 1 && RELIEF_OUT_DEPTH == 2 &&
                RELIEF_OUT_UV == 3 && RELIEF_OUT_PATCH == 4);
  Framebuffer front = make_framebuffer(gl, "front layer", &one->z_buffer,
                                       {&colour, address(targets.normal), address(targets.depth),
                                        address(targets.uv), address(targets.patch_id)});
  Framebuffer over = make_framebuffer(gl, "over", nullptr, {&targets.colour});
  const Status made = check_errors(gl, "the layers of semi-transparent surfaces");
  if (!made) return made.error();
  return Layers{
      std::move(colour), {std::move(*one), std::move(*other)}, std::move(front), std::move(over)};
}

}  // namespace relief::onepass
