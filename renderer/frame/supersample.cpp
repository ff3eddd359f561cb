#include "renderer/frame/supersample.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "renderer/frame/gl_engine.h"
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

Result<RenderResult> render_supersampled(GlPreparedModel& model, const RenderSettings& settings) {
  const Gl& gl = model.model().gl();
  std::optional<RenderResult> all;
  const Outputs& outputs = settings.outputs;
  if (outputs.normal || outputs.depth || outputs.uv || outputs.patch_id) {
    auto middles = model.render_once(settings);
    if (!middles) return middles.error();
    all = std::move(*middles);
  }
  RenderSettings coloured = settings;
  coloured.outputs = {};
  const auto resolve = model.model().resolve();
  if (!resolve) return resolve.error();
  const auto resolved = make_resolved(gl, settings.width, settings.height);
  if (!resolved) return resolved.error();
  for (const Raster& part : parts_of(settings.width, settings.height,
                                     samples_a_side(settings.samples), largest_target(gl))) {
    auto drawing = model.make_drawing(coloured, part);
    if (!drawing) return drawing.error();
    drawing->picture.resolve = {*resolve, &*resolved, part};
    auto drawn = model.model().draw(*drawing, coloured);
    if (!drawn) return drawn.error();
    add_part(std::move(*drawn), all);
  }
  Image colours = read_colour(gl, resolved->colour, settings.width, settings.height);
  if (all->image.channels.empty()) {
    all->image = std::move(colours);
  } else {
    replace_channels(std::move(colours), all->image);
  }
  finish_coverage(settings.background.has_value(), *all);
  return *std::move(all);
}

}  // namespace relief
