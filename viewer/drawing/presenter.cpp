#include "viewer/drawing/presenter.h"

#include <algorithm>
#include <cmath>

#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Those whose shade depends on the rows.
Rows with_neighbours(const Rows& rows, std::uint32_t height) {
  const auto reach = static_cast<std::uint32_t>(std::ceil(shared::kEyeDomeRadius * height)) + 1U;
  return {rows.bottom - std::min(reach, rows.bottom), std::min(rows.top + reach, height)};
}

}  // namespace

Result<Presenter> Presenter::create(const Gl& gl) {
  RELIEF_TRY_ASSIGN(Program plain, make_program(gl, "present", "environment/screen.vert",
                                                "viewer/present.frag", {}));
  RELIEF_TRY_ASSIGN(Program copy,
                    make_program(gl, "copy", "viewer/copy.vert", "viewer/copy.frag", {}));
  return Presenter(gl, std::move(plain), std::move(copy), VertexArray(gl, "no attributes"));
}

Result<const Program*> Presenter::program_for(const Presentation& how) {
  if (how.shade <= 0.0) return &plain_;
  if (!shaded_) {
    RELIEF_TRY_ASSIGN(shaded_, make_program(*gl_, "present shaded", "environment/screen.vert",
                                            "viewer/present_shaded.frag", {}));
  }
  return &*shaded_;
}

Status Presenter::encode(const Canvas& canvas, const Presentation& how, const Rows& rows) {
  const Gl& gl = *gl_;
  RELIEF_TRY_ASSIGN(const Program* const program, program_for(how));
  const Rows encoded = how.shade > 0.0 ? with_neighbours(rows, canvas.height) : rows;
  PassTimer timer(gl);
  const ScopedPass pass(gl, timer, "encode");
  gl.BindFramebuffer(GL_FRAMEBUFFER, canvas.shown_framebuffer.id());
  const auto left = static_cast<GLint>(std::lround(how.from * canvas.width));
  const auto right = static_cast<GLint>(std::lround(how.to * canvas.width));
  // Cuts the triangle off; pixels stay where they are.
  gl.Viewport(left, static_cast<GLint>(encoded.bottom), right - left,
              static_cast<GLsizei>(encoded.top - encoded.bottom));
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.UseProgram(program->id());
  gl.ProgramUniform1f(program->id(), RELIEF_UNIFORM_EXPOSURE,
                      static_cast<float>(std::exp2(how.exposure)));
  gl.BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, canvas.colour.id());
  if (how.shade > 0.0) {
    gl.ProgramUniform1f(program->id(), RELIEF_UNIFORM_SHADE, static_cast<float>(how.shade));
    gl.ProgramUniform1f(program->id(), RELIEF_UNIFORM_DEPTH_SCALE,
                        static_cast<float>(how.depth_scale));
    gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, canvas.depth.id());
  }
  gl.BindVertexArray(nothing_.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindVertexArray(0);
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, 0);
  gl.UseProgram(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  return {};
}

void Presenter::copy(const Canvas& canvas, glm::ivec2 window, GLuint framebuffer) const {
  const Gl& gl = *gl_;
  PassTimer timer(gl);
  const ScopedPass pass(gl, timer, "copy");
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  const bool is_whole = glm::ivec2(canvas.width, canvas.height) == window;
  gl.TextureParameteri(canvas.shown.id(), GL_TEXTURE_MAG_FILTER, is_whole ? GL_NEAREST : GL_LINEAR);
  gl.Viewport(0, 0, window.x, window.y);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_BLEND);
  gl.UseProgram(copy_.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, canvas.shown.id());
  gl.BindVertexArray(nothing_.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindVertexArray(0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PIXEL_SAMPLES, 0);
  gl.UseProgram(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace relief
