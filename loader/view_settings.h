// From the settings of a planned view to those of the renderer.
#pragma once

#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "loader/scene_plan.h"
#include "renderer/engine_registry.h"
#include "renderer/settings.h"

namespace relief {

/// The renderer's settings of a view, with the engine's defaults for what the plan leaves open.
/// Options of other engines do not count. `extent`: the bounds and the bounding sphere of all that
/// is drawn, which the camera depends on; its patches are not looked at. Outputs beside colour are
/// those that the plan names. Fails if the eye is where it looks, or the engine does not accept the
/// value of an option.
Result<RenderSettings> render_settings_of(const ScenePlan& plan, const PlannedView& view,
                                          const PatchModel& extent,
                                          std::span<const EngineEntry> among = engines());

/// The renderer's settings of all views, in their order.
Result<std::vector<RenderSettings>> render_settings_of(
    const ScenePlan& plan, const PatchModel& extent,
    std::span<const EngineEntry> among = engines());

/// The engine of a view: the one it names, or the first.
Result<const EngineEntry*> engine_of(const PlannedView& view,
                                     std::span<const EngineEntry> among = engines());

}  // namespace relief
