#include "viewer/drawing/canvas.h"

#include <utility>

#include "renderer/frame/targets/attachments.h"
#include "shaders/include/shared.h"

namespace relief {

Result<Canvas> make_canvas(const Gl& gl, std::uint32_t width, std::uint32_t height) {
  Texture colour = make_attachment(gl, "canvas", GL_RGBA16F, width, height);
  Texture depth = make_attachment(gl, "canvas depth", GL_DEPTH_COMPONENT32F, width, height);
  Texture shown = make_attachment(gl, "shown canvas", GL_RGBA8, width, height);
  // Enlarged, its outermost pixels reach to the window's edges.
  gl.TextureParameteri(shown.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TextureParameteri(shown.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  Framebuffer framebuffer = make_framebuffer(gl, "canvas", &depth, {{RELIEF_OUT_COLOUR, &colour}});
  Framebuffer shown_framebuffer =
      make_framebuffer(gl, "shown canvas", nullptr, {{RELIEF_OUT_COLOUR, &shown}});
  RELIEF_TRY(check_errors(gl, "the window's picture"));
  return Canvas{width,
                height,
                std::move(colour),
                std::move(depth),
                std::move(framebuffer),
                std::move(shown),
                std::move(shown_framebuffer)};
}

}  // namespace relief
