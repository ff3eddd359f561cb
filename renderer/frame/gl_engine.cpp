#include "renderer/frame/gl_engine.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "renderer/frame/image_parts.h"
#include "renderer/gl/software.h"

namespace relief {
namespace {

template <class T>
std::optional<T> sum_of(const std::optional<T>& a, const std::optional<T>& b) {
  return a && b ? std::optional<T>(*a + *b) : std::nullopt;
}

Status check_size(const RenderSettings& settings) {
  const auto fits = [](std::uint32_t side) { return side >= 1 && side <= kMaxRenderSide; };
  if (fits(settings.width) && fits(settings.height)) return {};
  return make_error("an image of {}x{} pixels can't be drawn: a side has 1 to {}", settings.width,
                    settings.height, kMaxRenderSide);
}

}  // namespace

Result<Image> GlPreparedModel::probe(const RenderSettings& settings, std::uint32_t x,
                                     std::uint32_t y) {
  const Gl& gl = model().gl();
  RenderSettings wanted = settled(settings);
  wanted.samples = 1;
  wanted.outputs = {};
  wanted.outputs.depth = true;
  wanted.outputs.patch_id = true;
  RELIEF_TRY_ASSIGN(const GlFrame frame, model().make_frame(wanted, Raster{x, y, 1, 1, 1}));
  RELIEF_TRY_ASSIGN(const auto drawing, make_drawing(frame, wanted, Counting::Off));
  PassTimer timer(gl);
  draw_frame(gl, frame, *drawing, timer);
  Image pixel = read_targets(gl, frame.targets);
  RELIEF_TRY(check_errors(gl, "the pixel"));
  return pixel;
}

Result<RenderResult> GlPreparedModel::render(const RenderSettings& asked, Progress& progress) {
  RELIEF_TRY(check_size(asked));
  if (asked.samples > 1) return render_supersampled(asked, progress);
  const RenderSettings settings = settled(asked);
  const std::vector<Raster> parts =
      parts_of(settings.width, settings.height, 1, largest_target(model_->gl()));
  if (parts.size() > 1) progress.begin_stage("render", parts.size());
  std::optional<RenderResult> all;
  for (const Raster& part : parts) {
    if (progress.cancelled()) return interrupted_error();
    RELIEF_TRY_ASSIGN(RenderResult drawn, render_part(settings, part, progress));
    add_part(std::move(drawn), part, settings, all);
    if (parts.size() > 1) progress.advance(1);
  }
  if (!asked.outputs.patch_id) {
    std::erase_if(all->image.channels,
                  [](const Channel& channel) { return channel.name == "patch"; });
  }
  return *std::move(all);
}

Result<RenderResult> GlPreparedModel::render_part(const RenderSettings& settings,
                                                  const Raster& part, const Progress& progress) {
  const Gl& gl = model_->gl();
  RELIEF_TRY_ASSIGN(const GlFrame frame, model_->make_frame(settings, part));
  RELIEF_TRY_ASSIGN(const auto drawing, make_drawing(frame, settings, Counting::Off));
  RELIEF_TRY_ASSIGN(const auto fragments, count_if_asked(frame, settings));
  FrameClock clock(gl);
  draw_frame(gl, frame, *drawing, clock.timer());
  RELIEF_TRY_ASSIGN(RenderResult result,
                    measure(frame, *drawing, settings, clock.finish(), progress));
  result.fragments = fragments;
  read_frame(gl, frame, settings.background.has_value(), result);
  return result;
}

void add_cost(const RenderResult& drawn, RenderResult& all) {
  all.frame_ms += drawn.frame_ms;
  all.gpu_ms = sum_of(all.gpu_ms, drawn.gpu_ms);
  all.fragments = sum_of(all.fragments, drawn.fragments);
  if (all.explanation && drawn.explanation) append(*all.explanation, *drawn.explanation);
  for (const PassTime& pass : drawn.passes) add_pass(all.passes, pass);
}

void add_part(RenderResult drawn, const Raster& part, const RenderSettings& settings,
              std::optional<RenderResult>& all) {
  const bool is_whole = part.width == settings.width && part.height == settings.height;
  const Image image = is_whole ? Image() : std::move(drawn.image);
  if (!all) {
    all = std::move(drawn);
    if (is_whole) return;
    all->image = {settings.width, settings.height, {}};
    for (const Channel& channel : image.channels) {
      all->image.channels.push_back({channel.name, channel.type, {}});
      all->image.channels.back().values.resize(std::size_t{settings.width} * settings.height);
    }
  } else {
    add_cost(drawn, *all);
    all->covered_pixels += drawn.covered_pixels;
  }
  const std::size_t top = settings.height - (part.bottom + part.height);
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    for (std::size_t y = 0; y < part.height; ++y) {
      std::copy_n(image.channels[c].values.data() + y * part.width, part.width,
                  all->image.channels[c].values.data() + (top + y) * settings.width + part.left);
    }
  }
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
                                              const RenderSettings& settings, FrameTime first,
                                              const Progress& progress) const {
  const Gl& gl = model_->gl();
  RenderResult result;
  result.renderer = renderer_name(gl);
  result.frame_ms = first.wall_ms;
  result.gpu_ms = first.gpu_ms;
  RELIEF_TRY(time_frames(gl, frame, drawing, settings.frames, progress, result));
  if (gl.recorder != nullptr) result.explanation = gl.recorder->explain();
  if (settings.pass_frames > 0) {
    RELIEF_TRY_ASSIGN(result.passes, time_passes(gl, settings.pass_frames, progress,
                                                 [&](PassTimer& timer) -> Status {
                                                   draw_frame(gl, frame, drawing, timer);
                                                   return {};
                                                 }));
  }
  RELIEF_TRY(check_errors(gl, "the image"));
  RELIEF_TRY(model_->status());
  return result;
}

}  // namespace relief
