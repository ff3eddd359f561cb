#include "renderer/frame/gl_frame.h"

#include <algorithm>
#include <span>
#include <vector>

#include "shaders/include/shared.h"

#include "common/median.h"

namespace relief {
namespace {

void bind_frame(const Gl& gl, const GlFrame& frame) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, frame.targets.framebuffer.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(frame.targets.width),
              static_cast<GLsizei>(frame.targets.height));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, frame.uniforms.id());
  if (frame.materials)
    gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_MATERIALS, frame.materials->id());
  const Texture* const rough = frame.rough_environments;
  gl.BindTextureUnit(RELIEF_TEXTURE_ROUGH_ENVIRONMENTS, rough == nullptr ? 0 : rough->id());
}

void unbind_frame(const Gl& gl) {
  gl.BindTextureUnit(RELIEF_TEXTURE_ROUGH_ENVIRONMENTS, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_MATERIALS, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace

void draw_frame(const Gl& gl, const GlFrame& frame, const GlDrawing& drawing, PassTimer& timer) {
  if (gl.recorder != nullptr) gl.recorder->begin_frame();
  bind_frame(gl, frame);
  clear_targets(gl, frame.targets, frame.background);
  drawing.draw(frame, timer);
  if (frame.backdrop != nullptr) frame.backdrop->draw(timer, *frame.surroundings);
  drawing.draw_over(frame, timer);
  if (frame.resolve) frame.resolve->draw(timer, frame.targets.colour);
  unbind_frame(gl);
}

FrameTime FrameClock::finish() {
  gl_->Finish();
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double, std::milli> elapsed = now - start_;
  start_ = now;
  return {elapsed.count(), timer_.take()};
}

FrameTime time_frame(const Gl& gl, const GlFrame& frame, const GlDrawing& drawing) {
  FrameClock clock(gl);
  draw_frame(gl, frame, drawing, clock.timer());
  return clock.finish();
}

Status time_frames(const Gl& gl, const GlFrame& frame, const GlDrawing& drawing, int frames,
                   const Progress& progress, RenderResult& result) {
  std::vector<double> frame_ms;
  std::vector<double> gpu_ms;
  for (int i = 0; i < frames; ++i) {
    if (progress.cancelled()) return interrupted_error();
    const FrameTime time = time_frame(gl, frame, drawing);
    frame_ms.push_back(time.wall_ms);
    if (time.gpu_ms) gpu_ms.push_back(*time.gpu_ms);
  }
  if (!frame_ms.empty()) result.frame_ms = median_of(frame_ms);
  if (!gpu_ms.empty()) result.gpu_ms = median_of(gpu_ms);
  return {};
}

std::uint64_t count_fragments(const Gl& gl, const GlFrame& frame, const GlDrawing& counting) {
  const Buffer buffer = draw_counting(gl, frame, counting, CountsOf::Frame);
  std::uint32_t count = 0;
  gl.GetNamedBufferSubData(buffer.id(), sizeof(count), sizeof(count), &count);
  return count;
}

Buffer draw_counting(const Gl& gl, const GlFrame& frame, const GlDrawing& counting, CountsOf of) {
  const std::size_t width = of == CountsOf::Pixels ? frame.targets.width : 0;
  std::vector<std::uint32_t> zeros(1 + std::max<std::size_t>(width * frame.targets.height, 1));
  zeros.front() = static_cast<std::uint32_t>(width);
  Buffer buffer = make_buffer(gl, "fragment counts", std::span<const std::uint32_t>(zeros));
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, buffer.id());
  PassTimer timer(gl);
  draw_frame(gl, frame, counting, timer);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, 0);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return buffer;
}

void read_frame(const Gl& gl, const GlFrame& frame, bool opaque, RenderResult& result) {
  result.image = read_targets(gl, frame.targets);
  finish_coverage(opaque, result);
}

void finish_coverage(bool opaque, RenderResult& result) {
  for (Channel& channel : result.image.channels) {
    if (channel.name != "A") continue;
    result.covered_pixels = static_cast<std::uint64_t>(std::count_if(
        channel.values.begin(), channel.values.end(), [](float alpha) { return alpha > 0.0F; }));
    if (opaque) std::fill(channel.values.begin(), channel.values.end(), 1.0F);
  }
}

}  // namespace relief
