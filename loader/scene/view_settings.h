// From the settings of a planned view to those of the renderer.
#pragma once

#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "loader/scene/scene_plan.h"
#include "renderer/engine_registry.h"
#include "renderer/settings.h"

namespace relief {

/// Returns the renderer's settings of a view, with the engine's defaults for options that the plan
/// does not set. Ignores options of other engines. `extent`: bounds and bounding sphere of the
/// whole scene, for the camera; its patches are not used. Outputs beside colour are those that the
/// plan names. Fails if the eye is at its target, or if the engine does not accept the value of an
/// option.
Result<RenderSettings> render_settings_of(const ScenePlan& plan, const PlannedView& view,
                                          const PatchModel& extent,
                                          std::span<const EngineEntry> among = engines());

/// Returns the same but for the camera, for which nothing needs to be known of the scene.
Result<RenderSettings> look_of(const ScenePlan& plan, const PlannedView& view,
                               std::span<const EngineEntry> among = engines());

/// Returns the renderer's settings of all views, in order; of a film, those of its frames.
Result<std::vector<RenderSettings>> render_settings_of(
    const ScenePlan& plan, const PatchModel& extent,
    std::span<const EngineEntry> among = engines());

/// The engine of a view: the one it names, or the first.
Result<const EngineEntry*> engine_of(const PlannedView& view,
                                     std::span<const EngineEntry> among = engines());

}  // namespace relief
