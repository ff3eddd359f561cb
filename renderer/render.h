// From a model to images, without a display.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/engine_registry.h"
#include "renderer/model.h"
#include "renderer/result.h"
#include "renderer/settings.h"

namespace relief {

/// Takes an image as soon as it is done; `view` is its index in the list. An error ends the
/// rendering and is returned from it. Must not render: OpenGL has one context at a time.
using ImageSink = std::function<Status(std::size_t view, RenderResult image)>;

/// Renders several views of one model, one engine after the other and each engine's in the list's
/// order. What does not depend on the view (an OpenGL context, the model on the GPU, environments)
/// is made once for each engine; no image depends on another. All views have the same `platform`,
/// `debug` and `explain`. `among`: the engines that views can name. Fails, with one sentence: no
/// OpenGL, an unreadable environment, an image larger than OpenGL allows, materials that the engine
/// does not draw, an interruption by the user, an error of the sink.
Status render_views(const RenderModel& model, std::span<const RenderSettings> views,
                    const ImageSink& sink, Progress& progress,
                    std::span<const EngineEntry> among = engines());

/// Renders one view of a model. Fails as render_views() does.
Result<RenderResult> render(const RenderModel& model, const RenderSettings& settings,
                            Progress& progress, std::span<const EngineEntry> among = engines());

/// Renders patches with any engine.
Result<RenderResult> render(const PatchModel& patches, const RenderSettings& settings,
                            Progress& progress);

/// Renders a mesh with the engine `raytrace`, whatever `settings.engine` is.
Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress);

/// Renders points with the engine `ewa`, whatever `settings.engine` is.
Result<RenderResult> render(const SplatCloud& splats, const RenderSettings& settings,
                            Progress& progress);

}  // namespace relief
