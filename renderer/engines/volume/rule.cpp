#include "renderer/engines/volume/rule.h"

namespace relief::volume {

shared::VolumeRule shader_rule(const VolumeFrame& frame) {
  const VolumeSettings& settings = frame.settings.volume;
  const GaussianSettings& gaussians = settings.gaussians;
  const bool is_peak = frame.cloud.weight == KernelWeight::Peak;
  std::uint32_t flags = is_peak ? RELIEF_VOLUME_PEAK : 0U;
  if (!is_peak && settings.attenuation == Attenuation::Exponential)
    flags |= RELIEF_VOLUME_EXPONENTIAL;
  const std::uint32_t columns = (frame.view.width + shared::kVolumeTile - 1) / shared::kVolumeTile;
  shared::VolumeRule rule{};
  rule.image = {frame.view.width, frame.view.height, columns, flags};
  rule.limits = is_peak ? glm::vec4(gaussians.min_alpha, gaussians.max_alpha,
                                    gaussians.min_transmittance, 0.0)
                        : glm::vec4(0.0F, 1.0F, 1e-6F, 0.0F);
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
