// Images by the engine `ewa`, from points to pixels.
#pragma once

#include <functional>
#include <memory>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/engine.h"
#include "renderer/engines/ewa/clipped_cloud.h"
#include "renderer/engines/ewa/splat_hierarchy.h"
#include "renderer/result.h"
#include "renderer/settings.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief::ewa {

/// The model's points, or without any the samples of its patches, for any number of views.
/// Environments and coarser levels are made when first needed.
Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

/// Receives an image that a finer one may follow.
using ShowImage = std::function<void(const RenderResult&)>;

/// A level of larger splats is no image of the model, and takes longer: as many pixels are
/// covered, by splats that agree less.
inline constexpr double kCoarsestPixels = 4.0;
/// The low-pass filter, of one pixel, hides what levels finer than this would add.
inline constexpr double kFinestPixels = 0.5;

/// Draws the level of kCoarsestPixels, whatever it takes, and then finer ones, each whole and once,
/// while `settings.ewa.time_budget_ms` lasts: a level is not begun if, at the pace of the last one,
/// it would not be done in time. Ends with the level of kFinestPixels. Each image is shown, also
/// the last, which is returned; what clips the levels is found before the time runs; `level` says
/// which it is, frame_ms how long it took. Which level is reached depends on the machine; a level's
/// image does not.
Result<RenderResult> render_progressive(const SplatHierarchy& hierarchy,
                                        EnvironmentCache& environments, ClipCache& clips,
                                        const RenderSettings& settings, const ShowImage& show,
                                        Progress& progress);

}  // namespace relief::ewa
