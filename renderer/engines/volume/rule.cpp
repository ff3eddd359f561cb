#include "renderer/engines/volume/rule.h"

#include "renderer/volume/splats/composite_rule.h"

namespace relief::volume {

shared::VolumeRule shader_rule(const VolumeFrame& frame) {
  const CompositeRule composite = composite_rule(frame.settings.volume, frame.cloud.weight);
  const bool is_peak = composite.weight == KernelWeight::Peak;
  std::uint32_t flags = is_peak ? RELIEF_VOLUME_PEAK : 0U;
  if (!is_peak && composite.attenuation == Attenuation::Exponential)
    flags |= RELIEF_VOLUME_EXPONENTIAL;
  if (!frame.limits.empty()) flags |= RELIEF_VOLUME_LIMITED;
  const std::uint32_t columns = (frame.view.width + shared::kVolumeTile - 1) / shared::kVolumeTile;
  shared::VolumeRule rule{};
  rule.image = {frame.view.width, frame.view.height, columns, flags};
  rule.limits = {composite.min_alpha, composite.max_alpha, composite.min_transmittance, 0.0};
  return rule;
}

void draw_screen(const Gl& gl, const VolumeTargets& targets, const Program& program,
                 const Buffer& rule, const VertexArray& nothing) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, targets.framebuffer.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(targets.width), static_cast<GLsizei>(targets.height));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_RULE, rule.id());
  gl.UseProgram(program.id());
  gl.BindVertexArray(nothing.id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_RULE, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace relief::volume
