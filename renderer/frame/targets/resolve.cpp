#include "renderer/frame/targets/resolve.h"

#include <utility>

#include "renderer/frame/targets/attachments.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief {

Result<ResolvedColour> make_resolved(const Gl& gl, std::uint32_t width, std::uint32_t height) {
  Texture colour = make_attachment(gl, "resolved colour", GL_RGBA16F, width, height);
  Framebuffer framebuffer =
      make_framebuffer(gl, "resolved", nullptr, {{RELIEF_OUT_COLOUR, &colour}});
  RELIEF_TRY(check_errors(gl, "the image"));
  return ResolvedColour{std::move(framebuffer), std::move(colour)};
}

Result<Resolve> Resolve::create(const Gl& gl) {
  RELIEF_TRY_ASSIGN(Program program, make_program(gl, "resolve", "environment/screen.vert",
                                                  "resolve/mean.frag", {}));
  return Resolve(gl, std::move(program), VertexArray(gl, "no attributes"));
}

void Resolve::draw(PassTimer& timer, const Texture& samples, const Raster& part,
                   GLuint framebuffer) const {
  const ScopedPass pass(*gl_, timer, "resolve");
  const auto left = static_cast<GLint>(part.left);
  const auto bottom = static_cast<GLint>(part.bottom);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_->Viewport(left, bottom, static_cast<GLsizei>(part.width), static_cast<GLsizei>(part.height));
  gl_->BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, samples.id());
  gl_->UseProgram(program_.id());
  gl_->ProgramUniform3i(program_.id(), RELIEF_UNIFORM_PART, left, bottom,
                        static_cast<GLint>(part.side));
  gl_->BindVertexArray(nothing_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->BindVertexArray(0);
  gl_->UseProgram(0);
  gl_->BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, 0);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace relief
