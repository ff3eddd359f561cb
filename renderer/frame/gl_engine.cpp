#include "renderer/frame/gl_engine.h"

#include <algorithm>

namespace relief {

Result<RenderResult> GlPreparedModel::render(const RenderSettings& asked, Progress& progress) {
  if (asked.samples > 1) return render_supersampled(asked, progress);
  const Gl& gl = model_->gl();
  const RenderSettings settings = settled(asked);
  RELIEF_TRY_ASSIGN(const GlFrame frame, model_->make_frame(settings, whole_of(settings)));
  RELIEF_TRY_ASSIGN(const auto drawing, make_drawing(frame, settings, Counting::Off));
  RELIEF_TRY_ASSIGN(const auto fragments, count_if_asked(frame, settings));
  FrameClock clock(gl);
  draw_frame(gl, frame, *drawing, clock.timer());
  RELIEF_TRY_ASSIGN(RenderResult result, measure(frame, *drawing, settings, clock.finish()));
  result.fragments = fragments;
  read_frame(gl, frame, settings.background.has_value(), result);
  if (!asked.outputs.patch_id) {
    std::erase_if(result.image.channels,
                  [](const Channel& channel) { return channel.name == "patch"; });
  }
  return result;
}

Result<std::optional<std::uint64_t>> GlPreparedModel::count_if_asked(
    const GlFrame& frame, const RenderSettings& settings) {
  std::optional<std::uint64_t> fragments;
  if (!settings.count_fragments || settings.explain) return fragments;
  RELIEF_TRY_ASSIGN(const auto counting, make_drawing(frame, settings, Counting::On));
  if (counting != nullptr) fragments = count_fragments(model_->gl(), frame, *counting);
  return fragments;
}

Result<RenderResult> GlPreparedModel::measure(const GlFrame& frame, const GlDrawing& drawing,
                                              const RenderSettings& settings,
                                              FrameTime first) const {
  const Gl& gl = model_->gl();
  RenderResult result;
  result.renderer = renderer_name(gl);
  result.frame_ms = first.wall_ms;
  result.gpu_ms = first.gpu_ms;
  time_frames(gl, frame, drawing, settings.frames, result);
  if (gl.recorder != nullptr) result.explanation = gl.recorder->explain();
  RELIEF_TRY(check_errors(gl, "the image"));
  RELIEF_TRY(model_->status());
  return result;
}

}  // namespace relief
