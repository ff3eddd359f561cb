// Images with several samples a pixel, of any engine on OpenGL.
#include "renderer/frame/gl_engine.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "renderer/frame/image_parts.h"

namespace relief {
namespace {

template <class T>
std::optional<T> sum_of(const std::optional<T>& a, const std::optional<T>& b) {
  return a && b ? std::optional<T>(*a + *b) : std::nullopt;
}

/// What a part took, added to what the parts before it did.
void add_part(RenderResult part, std::optional<RenderResult>& all) {
  if (!all) {
    all = std::move(part);
    return;
  }
  all->frame_ms += part.frame_ms;
  all->gpu_ms = sum_of(all->gpu_ms, part.gpu_ms);
  all->fragments = sum_of(all->fragments, part.fragments);
  if (all->explanation && part.explanation) append(*all->explanation, *part.explanation);
}

/// Puts the channels of `colours` in the place of those of their names.
void replace_channels(Image colours, Image& image) {
  for (Channel& channel : colours.channels) {
    const auto old = std::find_if(image.channels.begin(), image.channels.end(),
                                  [&channel](const Channel& c) { return c.name == channel.name; });
    *old = std::move(channel);
  }
}

}  // namespace

Result<RenderResult> GlPreparedModel::render_supersampled(const RenderSettings& asked,
                                                          Progress& progress) {
  const Gl& gl = model_->gl();
  std::optional<RenderResult> all;
  const Outputs& outputs = asked.outputs;
  RenderSettings one_sample = asked;
  one_sample.samples = 1;
  if (outputs.normal || outputs.depth || outputs.uv || outputs.patch_id) {
    RELIEF_TRY_ASSIGN(all, render(one_sample, progress));
  }
  one_sample.outputs = {};
  const RenderSettings coloured = settled(one_sample);
  RELIEF_TRY_ASSIGN(const auto resolve, model_->resolve());
  RELIEF_TRY_ASSIGN(const auto resolved, make_resolved(gl, asked.width, asked.height));
  for (const Raster& part :
       parts_of(asked.width, asked.height, samples_a_side(asked.samples), largest_target(gl))) {
    RELIEF_TRY_ASSIGN(GlFrame frame, model_->make_frame(coloured, part));
    frame.resolve = {resolve, &resolved, part};
    RELIEF_TRY_ASSIGN(const auto drawing, make_drawing(frame, coloured, Counting::Off));
    RELIEF_TRY_ASSIGN(const auto fragments, count_if_asked(frame, coloured));
    FrameClock clock(gl);
    draw_frame(gl, frame, *drawing, clock.timer());
    RELIEF_TRY_ASSIGN(RenderResult drawn, measure(frame, *drawing, coloured, clock.finish()));
    drawn.fragments = fragments;
    add_part(std::move(drawn), all);
  }
  Image colours = read_colour(gl, resolved.colour, asked.width, asked.height);
  if (all->image.channels.empty()) {
    all->image = std::move(colours);
  } else {
    replace_channels(std::move(colours), all->image);
  }
  finish_coverage(asked.background.has_value(), *all);
  return *std::move(all);
}

}  // namespace relief
