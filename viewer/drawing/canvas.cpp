#include "viewer/drawing/canvas.h"

#include <utility>

#include "renderer/frame/attachments.h"
#include "shaders/include/shared.h"

namespace relief {

Result<Canvas> make_canvas(const Gl& gl, std::uint32_t width, std::uint32_t height) {
  Texture colour = make_attachment(gl, "canvas", GL_RGBA16F, width, height);
  Texture depth = make_attachment(gl, "canvas depth", GL_DEPTH_COMPONENT32F, width, height);
  // A coarse picture is shown larger than it is.
  gl.TextureParameteri(colour.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TextureParameteri(colour.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TextureParameteri(colour.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TextureParameteri(colour.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  Framebuffer framebuffer = make_framebuffer(gl, "canvas", &depth, {{RELIEF_OUT_COLOUR, &colour}});
  RELIEF_TRY(check_errors(gl, "the window's picture"));
  return Canvas{width, height, std::move(colour), std::move(depth), std::move(framebuffer)};
}

}  // namespace relief
