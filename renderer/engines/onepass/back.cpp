#include "renderer/engines/onepass/back.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "renderer/frame/sample_draws.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/view/uniforms.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

/// As much of the border as OpenGL has room for.
View view_behind(const Gl& gl, const View& whole) {
  const std::uint32_t longer = std::max(whole.width, whole.height);
  const auto wanted = static_cast<std::uint32_t>(std::ceil(kBackBorder * longer));
  const std::uint32_t largest = largest_target(gl);
  return with_border(whole, std::min(wanted, (largest - std::min(largest, longer)) / 2));
}

}  // namespace

Result<Back> make_back(const Gl& gl, const View& whole, MaterialChoice materials,
                       Features features) {
  const View view = view_behind(gl, whole);
  Texture z_buffer =
      make_attachment(gl, "back depth buffer", GL_DEPTH_COMPONENT32F, view.width, view.height);
  Result<Visibility> found = make_visibility(gl, {view.width, view.height}, z_buffer, features,
                                             {"back coordinates", "back depths", "back"});
  if (!found) return found.error();
  const shared::Frame frame = make_frame(view, largest_sprite(gl), {});
  return Back{view, std::move(materials), std::move(z_buffer), std::move(*found),
              make_buffer(gl, "back frame", std::span<const shared::Frame>(&frame, 1))};
}

void clear_back(const Gl& gl, const Back& back) {
  const GLuint id = back.found.framebuffer.id();
  const std::array<GLfloat, 4> nothing{};
  gl.ClearNamedFramebufferfv(id, GL_DEPTH, 0, nothing.data());
  gl.ClearNamedFramebufferfv(id, GL_COLOR, RELIEF_OUT_VISIBILITY_DEPTH, nothing.data());
}

void bind_back(const Gl& gl, const Back& back, const Table& bodies) {
  gl.BindTextureUnit(RELIEF_TEXTURE_BACK_COORDINATES, back.found.coordinates.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_BACK_DEPTHS, back.found.depths->id());
  gl.BindTextureUnit(RELIEF_TEXTURE_BODIES, bodies.texture.id());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_BACK_FRAME, back.uniforms.id());
}

void unbind_back(const Gl& gl) {
  gl.BindTextureUnit(RELIEF_TEXTURE_BACK_COORDINATES, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_BACK_DEPTHS, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_BODIES, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_BACK_FRAME, 0);
}

}  // namespace relief::onepass
