#include "renderer/frame/gl_image.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <vector>

#include "renderer/frame/median.h"
#include "renderer/gl/pass.h"

namespace relief {
namespace {

/// Draws one frame, without waiting for it.
void draw_frame(const Gl& gl, const GlDrawing& drawing, const DrawModel& draw, PassTimer& timer) {
  const GlPicture& picture = drawing.picture;
  if (gl.recorder != nullptr) gl.recorder->begin_frame();
  gl.BindFramebuffer(GL_FRAMEBUFFER, picture.targets.framebuffer.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(picture.targets.width),
              static_cast<GLsizei>(picture.targets.height));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, picture.uniforms.id());
  if (picture.materials)
    gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_MATERIALS, picture.materials->id());
  const Texture* const rough = picture.rough_environments;
  gl.BindTextureUnit(RELIEF_TEXTURE_ROUGH_ENVIRONMENTS, rough == nullptr ? 0 : rough->id());
  clear_targets(gl, picture.targets, picture.background);
  draw(picture, timer);
  if (picture.backdrop != nullptr) picture.backdrop->draw(timer, *picture.surroundings);
  if (drawing.draw_over) drawing.draw_over(picture, timer);
  if (picture.resolve) picture.resolve->draw(timer, picture.targets.colour);
  gl.BindTextureUnit(RELIEF_TEXTURE_ROUGH_ENVIRONMENTS, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_MATERIALS, 0);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

/// Times frames after one that warms caches up and compiles what OpenGL compiles late.
void time_frames(const Gl& gl, const GlDrawing& drawing, int frames, RenderResult& result) {
  PassTimer timer(gl);
  (void)time_frame(gl, drawing, timer);
  std::vector<double> frame_ms;
  std::vector<double> gpu_ms;
  for (int i = 0; i < std::max(frames, 1); ++i) {
    const FrameTime time = time_frame(gl, drawing, timer);
    frame_ms.push_back(time.wall_ms);
    if (time.gpu_ms) gpu_ms.push_back(*time.gpu_ms);
  }
  result.frame_ms = median(frame_ms);
  if (!gpu_ms.empty()) result.gpu_ms = median(gpu_ms);
}

}  // namespace

FrameTime time_frame(const Gl& gl, const GlDrawing& drawing, PassTimer& timer) {
  const auto start = std::chrono::steady_clock::now();
  draw_frame(gl, drawing, drawing.draw, timer);
  gl.Finish();
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  return {elapsed.count(), timer.take()};
}

std::uint64_t count_fragments(const Gl& gl, const GlDrawing& drawing) {
  std::uint32_t count = 0;
  const Buffer buffer =
      make_buffer(gl, "fragment count", std::span<const std::uint32_t>(&count, 1));
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, buffer.id());
  PassTimer timer(gl);
  draw_frame(gl, drawing, drawing.count, timer);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, 0);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.GetNamedBufferSubData(buffer.id(), 0, sizeof(count), &count);
  return count;
}

void read_picture(const Gl& gl, const GlPicture& picture, bool opaque, RenderResult& result) {
  result.image = read_targets(gl, picture.targets);
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

std::string renderer_name(const Gl& gl) {
  return reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
}

Result<RenderResult> draw_picture(const Gl& gl, const GlDrawing& drawing,
                                  const RenderSettings& settings) {
  RenderResult result;
  result.renderer = renderer_name(gl);
  if (drawing.count) result.fragments = count_fragments(gl, drawing);
  time_frames(gl, drawing, settings.frames, result);
  if (gl.recorder != nullptr) result.explanation = gl.recorder->explain();
  const Status drawn = check_errors(gl, "the picture");
  if (!drawn) return drawn.error();
  return result;
}

}  // namespace relief
