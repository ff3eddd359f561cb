#include "viewer/drawing/presenter.h"

#include <cmath>

#include "renderer/gl/pass.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief {

Result<Presenter> Presenter::create(const Gl& gl) {
  RELIEF_TRY_ASSIGN(Program program, make_program(gl, "present", "environment/screen.vert",
                                                  "viewer/present.frag", {}));
  return Presenter(gl, std::move(program), VertexArray(gl, "no attributes"));
}

void Presenter::draw(const Canvas& canvas, glm::ivec2 window, const Presentation& how) const {
  const Gl& gl = *gl_;
  PassTimer timer(gl);
  const ScopedPass pass(gl, timer, "present");
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  const auto left = static_cast<GLint>(std::lround(how.from * window.x));
  const auto right = static_cast<GLint>(std::lround(how.to * window.x));
  gl.Viewport(left, 0, right - left,
              window.y);  // cuts the triangle off; pixels stay where they are
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.UseProgram(program_.id());
  gl.ProgramUniform1f(program_.id(), RELIEF_UNIFORM_EXPOSURE,
                      static_cast<float>(std::exp2(how.exposure)));
  gl.ProgramUniform1f(program_.id(), RELIEF_UNIFORM_SHADE, static_cast<float>(how.shade));
  gl.ProgramUniform1f(program_.id(), RELIEF_UNIFORM_DEPTH_SCALE,
                      static_cast<float>(how.depth_scale));
  gl.ProgramUniform3i(program_.id(), RELIEF_UNIFORM_WINDOW, window.x, window.y, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, canvas.colour.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, canvas.depth.id());
  gl.BindVertexArray(nothing_.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindVertexArray(0);
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, 0);
  gl.UseProgram(0);
}

}  // namespace relief
