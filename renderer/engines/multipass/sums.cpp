#include "renderer/engines/multipass/sums.h"

#include <array>
#include <initializer_list>

#include "renderer/features.h"
#include "shaders/include/shared.h"

namespace relief::multipass {
namespace {

/// An attachment, or null where there is none.
struct Attachment {
  GLuint location;
  const Texture* texture;
};

const Texture* address(const std::optional<Texture>& texture) {
  return texture ? &*texture : nullptr;
}

Framebuffer make_framebuffer(const Gl& gl, const char* label, const Texture& z_buffer,
                             std::initializer_list<Attachment> attachments) {
  Framebuffer framebuffer(gl, label);
  const GLuint id = framebuffer.id();
  gl.NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, z_buffer.id(), 0);
  std::array<GLenum, 5> draw{};  // GL_NONE
  for (const auto& [location, texture] : attachments) {
    if (texture == nullptr) continue;
    draw[location] = GL_COLOR_ATTACHMENT0 + location;
    gl.NamedFramebufferTexture(id, draw[location], texture->id(), 0);
  }
  gl.NamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw.size()), draw.data());
  return framebuffer;
}

}  // namespace

Result<Sums> make_sums(const Gl& gl, const Targets& targets, std::uint32_t features) {
  const auto make = [&](bool needed, const char* label, GLenum format) {
    std::optional<Texture> texture;
    if (!needed) return texture;
    texture.emplace(gl, label, GLenum{GL_TEXTURE_2D});
    gl.TextureStorage2D(texture->id(), 1, format, static_cast<GLsizei>(targets.width),
                        static_cast<GLsizei>(targets.height));
    return texture;
  };
  auto normals = make(needs_normals(features), "normal sums", GL_RGBA16F);
  auto colours = make((features & RELIEF_FEATURE_COLOURS) != 0, "colour sums", GL_RGBA16F);
  auto depths = make((features & (RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS)) != 0,
                     "depth sums", GL_RG32F);
  const Texture& z = targets.z_buffer;
  Framebuffer visibility = make_framebuffer(
      gl, "visibility", z,
      {{RELIEF_OUT_UV, address(targets.uv)}, {RELIEF_OUT_PATCH, address(targets.patch_id)}});
  Framebuffer accumulation = make_framebuffer(gl, "accumulation", z,
                                              {{RELIEF_SUM_NORMAL, address(normals)},
                                               {RELIEF_SUM_COLOUR, address(colours)},
                                               {RELIEF_SUM_DEPTH, address(depths)}});
  Framebuffer shading = make_framebuffer(gl, "shading", z,
                                         {{RELIEF_OUT_COLOUR, &targets.colour},
                                          {RELIEF_OUT_NORMAL, address(targets.normal)},
                                          {RELIEF_OUT_DEPTH, address(targets.depth)}});
  const Status made = check_errors(gl, "the sums of splats");
  if (!made) return made.error();
  return Sums{std::move(normals),    std::move(colours),      std::move(depths),
              std::move(visibility), std::move(accumulation), std::move(shading)};
}

void clear_sums(const Gl& gl, const Sums& sums) {
  const std::array<GLfloat, 4> zero{};
  const auto clear = [&](const std::optional<Texture>& sum, GLint location) {
    if (sum) gl.ClearNamedFramebufferfv(sums.accumulation.id(), GL_COLOR, location, zero.data());
  };
  clear(sums.normals, RELIEF_SUM_NORMAL);
  clear(sums.colours, RELIEF_SUM_COLOUR);
  clear(sums.depths, RELIEF_SUM_DEPTH);
}

}  // namespace relief::multipass
