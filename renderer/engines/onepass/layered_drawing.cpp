#include "renderer/engines/onepass/layered_drawing.h"

#include <array>
#include <utility>

#include "renderer/engines/onepass/cell_draws.h"
#include "shaders/include/shared.h"

namespace relief::onepass {

LayeredDrawing::LayeredDrawing(Parts parts)
    : opaque_(parts.opaque, std::move(parts.buffers), std::move(parts.opaque_materials)),
      layered_(parts.layered),
      layers_(std::move(parts.layers)),
      materials_(std::move(parts.transparent_materials)) {}

void LayeredDrawing::draw(const GlFrame& frame, PassTimer& timer) const {
  opaque_.draw(frame, timer);
}

/// Whether there is any surface of that number.
bool LayeredDrawing::find_layer(const GlFrame& frame, const DrawBatch& batch, std::size_t number,
                                PassTimer& timer) const {
  const Gl& gl = *layered_.gl;
  const Layer& layer = layers_.pair[number % 2];
  const Layer& before = layers_.pair[(number + 1) % 2];
  const ScopedPass pass(gl, timer, "layer visibility");
  const GLfloat nothing = 0.0F;
  gl.ClearNamedFramebufferfv(layer.visibility.framebuffer.id(), GL_DEPTH, 0, &nothing);
  gl.BindFramebuffer(GL_FRAMEBUFFER, layer.visibility.framebuffer.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, frame.targets.z_buffer.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_LAYER_DEPTH, before.z_buffer.id());
  const Query found(gl, "layer", GLenum{GL_ANY_SAMPLES_PASSED});
  gl.BeginQuery(GL_ANY_SAMPLES_PASSED, found.id());
  draw_cells(gl, layered_.programs, *batch.cells);
  gl.EndQuery(GL_ANY_SAMPLES_PASSED);
  gl.BindTextureUnit(RELIEF_TEXTURE_LAYER_DEPTH, 0);
  GLuint64 any = 0;
  gl.GetQueryObjectui64v(found.id(), GL_QUERY_RESULT, &any);
  return any != 0;
}

void LayeredDrawing::draw_over(const GlFrame& frame, PassTimer& timer) const {
  const Gl& gl = *layered_.gl;
  const Programs& programs = layered_.programs;
  const BoundModel bound(gl, layered_.samples, frame.environment);
  const DrawBatch batch = make_batch(layered_, frame.view, materials_);
  const std::array<GLfloat, 4> zero{};
  const GLfloat nearest = 1.0F;
  gl.ClearNamedFramebufferfv(layers_.pair[0].shading.id(), GL_COLOR, 0, zero.data());
  gl.ClearNamedFramebufferfv(layers_.pair[1].visibility.framebuffer.id(), GL_DEPTH, 0, &nearest);
  for (std::size_t k = 0; k < kMaxSurfaces; ++k) {
    if (!find_layer(frame, batch, k, timer)) break;
    const Layer& layer = layers_.pair[k % 2];
    const ScopedPass pass(gl, timer, "layer shading");
    gl.BindFramebuffer(GL_FRAMEBUFFER, (k == 0 ? layers_.front : layer.shading).id());
    if (k > 0) gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);  // under what is in front
    shade_found(gl, k == 0 ? *programs.shading : *programs.behind, layer.visibility,
                layer.z_buffer);
    gl.Disable(GL_BLEND);
  }
  const ScopedPass pass(gl, timer, "over");
  gl.BindFramebuffer(GL_FRAMEBUFFER, layers_.over.id());
  gl.Disable(GL_DEPTH_TEST);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.UseProgram(programs.over->id());
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBILITY, layers_.colour.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBILITY, 0);
  gl.BlendFunc(GL_ONE, GL_ZERO);
  gl.Disable(GL_BLEND);
  gl.BindFramebuffer(GL_FRAMEBUFFER, frame.targets.framebuffer.id());
}

}  // namespace relief::onepass
