#include "renderer/engines/onepass/drawing.h"

#include <cassert>
#include <utility>

#include "renderer/engines/onepass/cell_draws.h"
#include "renderer/engines/onepass/proxies.h"
#include "shaders/include/shared.h"

namespace relief::onepass {

Drawing::Drawing(const Variant& variant, Buffers buffers, MaterialChoice materials)
    : variant_(variant), buffers_(std::move(buffers)), materials_(std::move(materials)) {
  assert(buffers_.visibility.has_value() == variant_.programs.shading.has_value() &&
         "a frame that is shaded later has a visibility buffer");
}

void Drawing::draw(const GlFrame& frame, PassTimer& timer) const {
  const Gl& gl = *variant_.gl;
  const Programs& programs = variant_.programs;
  const BoundModel bound(gl, variant_.samples, frame.environment);
  if (buffers_.back) draw_back(frame, timer);
  const DrawBatch batch = make_batch(variant_, frame.view, materials_);
  if (buffers_.visibility) {
    {
      const ScopedPass pass(gl, timer, "visibility");
      gl.BindFramebuffer(GL_FRAMEBUFFER, buffers_.visibility->framebuffer.id());
      draw_cells(gl, programs, *batch.cells);
    }
    gl.BindFramebuffer(GL_FRAMEBUFFER, frame.targets.framebuffer.id());
    const ScopedPass pass(gl, timer, "shading");
    if (buffers_.back) bind_back(gl, *buffers_.back, *variant_.samples.store().bodies);
    shade_found(gl, *programs.shading, *buffers_.visibility, frame.targets.z_buffer);
    if (buffers_.back) unbind_back(gl);
  } else {
    const ScopedPass pass(gl, timer, "onepass");
    if (batch.cells) draw_cells(gl, programs, *batch.cells);
    if (batch.splats) variant_.samples.draw(*batch.splats, programs.main);
    if (batch.large) variant_.samples.draw(*batch.large, *programs.large_sprites);
  }
  if (batch.proxies.empty()) return;
  const ScopedPass pass(gl, timer, "proxies");
  draw_proxy_meshes(gl, *programs.proxy, *variant_.samples.store().proxies, batch.proxies);
}

void Drawing::draw_back(const GlFrame& frame, PassTimer& timer) const {
  const Gl& gl = *variant_.gl;
  const Back& back = *buffers_.back;
  const ScopedPass pass(gl, timer, "back");
  const DrawBatch batch = make_cell_batch(variant_, back.view, back.materials, SeenFrom::Behind);
  clear_back(gl, back);
  gl.BindFramebuffer(GL_FRAMEBUFFER, back.found.framebuffer.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(back.view.width), static_cast<GLsizei>(back.view.height));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, back.uniforms.id());
  draw_cells(gl, variant_.programs, *batch.cells, SeenFrom::Behind);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, frame.uniforms.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(frame.targets.width),
              static_cast<GLsizei>(frame.targets.height));
  gl.BindFramebuffer(GL_FRAMEBUFFER, frame.targets.framebuffer.id());
}

void shade_found(const Gl& gl, const Program& shading, const Visibility& visibility,
                 const Texture& visible_depth) {
  gl.DepthFunc(GL_LESS);  // the triangle is at 0, where what was found is above
  gl.DepthMask(GL_FALSE);
  gl.UseProgram(shading.id());
  gl.TextureBarrier();  // what is tested is read, too; nothing writes it in this pass
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, visible_depth.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBILITY, visibility.coordinates.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBILITY_DEPTH,
                     visibility.depths ? visibility.depths->id() : 0);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBILITY, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBILITY_DEPTH, 0);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_GREATER);
}

}  // namespace relief::onepass
