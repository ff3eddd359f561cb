// Images with several samples a pixel, of any engine on OpenGL.
#pragma once

#include "common/error.h"
#include "common/progress.h"
#include "renderer/result.h"
#include "renderer/settings.h"

namespace relief {

class GlPreparedModel;

/// Draws an image with at least `asked.samples` samples a pixel, in a square grid: the frame is
/// drawn that much larger, in parts if need be, and the mean of linear light and coverage is taken.
/// Normal, depth, UV and patch, if asked for, are those of the pixels' middles, from a frame of one
/// sample a pixel. The time is that of all these together. Fails as one of them does.
Result<RenderResult> render_supersampled(GlPreparedModel& model, const RenderSettings& asked,
                                         Progress& progress);

}  // namespace relief
