#include "renderer/frame/targets/attachments.h"

#include <vector>

namespace relief {

Texture make_attachment(const Gl& gl, const char* label, GLenum format, std::uint32_t width,
                        std::uint32_t height) {
  Texture texture(gl, label, GLenum{GL_TEXTURE_2D});
  gl.TextureStorage2D(texture.id(), 1, format, static_cast<GLsizei>(width),
                      static_cast<GLsizei>(height));
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

Framebuffer make_framebuffer(const Gl& gl, const char* label, const Texture* z_buffer,
                             std::initializer_list<ColourAttachment> colours) {
  Framebuffer framebuffer(gl, label);
  const GLuint id = framebuffer.id();
  if (z_buffer != nullptr) gl.NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, z_buffer->id(), 0);
  std::vector<GLenum> draw;
  for (const auto& [location, texture] : colours) {
    if (texture == nullptr) continue;
    if (draw.size() <= location) draw.resize(location + 1, GL_NONE);
    draw[location] = GL_COLOR_ATTACHMENT0 + location;
    gl.NamedFramebufferTexture(id, draw[location], texture->id(), 0);
  }
  gl.NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw.size()), draw.data());
  return framebuffer;
}

}  // namespace relief
