#include "renderer/engines/onepass/visibility.h"

#include <utility>

#include "shaders/include/shared.h"

namespace relief::onepass {

Result<Visibility> make_visibility(const Gl& gl, const Targets& targets) {
  Visibility made{Texture(gl, "what is seen", GLenum{GL_TEXTURE_2D}),
                  Framebuffer(gl, "what is seen")};
  gl.TextureStorage2D(made.found.id(), 1, GL_RGBA32F, static_cast<GLsizei>(targets.width),
                      static_cast<GLsizei>(targets.height));
  const GLuint id = made.framebuffer.id();
  gl.NamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, targets.z_buffer.id(), 0);
  gl.NamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0 + RELIEF_OUT_FOUND, made.found.id(), 0);
  const Status checked = check_errors(gl, "what is seen");
  if (!checked) return checked.error();
  return made;
}

}  // namespace relief::onepass
