// Images with several samples a pixel, of any engine on OpenGL.
#include "renderer/frame/gl_engine.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "renderer/frame/image_parts.h"

namespace relief {
namespace {

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
  const Outputs& outputs = asked.outputs;
  RenderSettings one_sample = asked;
  one_sample.samples = 1;
  std::optional<RenderResult> middles;  // of the pixels
  if (has_any(outputs)) {
    RELIEF_TRY_ASSIGN(middles, render(one_sample, progress));
  }
  one_sample.outputs = {};
  const RenderSettings coloured = settled(one_sample);
  RELIEF_TRY_ASSIGN(const auto resolve, model_->resolve());
  const std::vector<Raster> parts =
      parts_of(asked.width, asked.height, samples_a_side(asked.samples), largest_target(gl));
  if (parts.size() > 1) progress.begin_stage("render", parts.size());
  std::optional<RenderResult> all;
  for (const Raster& part : parts) {
    if (progress.cancelled()) return interrupted_error();
    RELIEF_TRY_ASSIGN(GlFrame frame, model_->make_frame(coloured, part));
    RELIEF_TRY_ASSIGN(const auto resolved, make_resolved(gl, part.width, part.height));
    frame.resolve = {
        resolve, resolved.framebuffer.id(), {0, 0, part.width, part.height, part.side}};
    RELIEF_TRY_ASSIGN(const auto drawing, make_drawing(frame, coloured, Counting::Off));
    RELIEF_TRY_ASSIGN(const auto fragments, count_if_asked(frame, coloured));
    FrameClock clock(gl);
    draw_frame(gl, frame, *drawing, clock.timer());
    RELIEF_TRY_ASSIGN(RenderResult drawn,
                      measure(frame, *drawing, coloured, clock.finish(), progress));
    drawn.fragments = fragments;
    drawn.image = read_colour(gl, resolved.colour, part.width, part.height);
    finish_coverage(asked.background.has_value(), drawn);
    add_part(std::move(drawn), part, asked, all);
    if (parts.size() > 1) progress.advance(1);
  }
  if (!middles) return *std::move(all);
  add_cost(*all, *middles);
  middles->covered_pixels = all->covered_pixels;
  replace_channels(std::move(all->image), middles->image);
  return *std::move(middles);
}

}  // namespace relief
