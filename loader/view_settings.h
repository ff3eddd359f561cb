// From the settings of a planned view to those of the renderer.
#pragma once

#include "common/error.h"
#include "common/patch.h"
#include "loader/scene_plan.h"
#include "renderer/render.h"

namespace relief {

/// The renderer's settings of a view, with the renderer's defaults for what the plan leaves open.
/// `extent`: the bounds and the bounding sphere of all that is drawn, which the camera depends on;
/// its patches are not looked at. Outputs beside colour are those that the plan names. Fails if the
/// eye is where it looks.
Result<RenderSettings> render_settings_of(const ScenePlan& plan, const PlannedView& view,
                                          const PatchModel& extent);

/// The renderer's settings of all views, in their order.
Result<std::vector<RenderSettings>> render_settings_of(const ScenePlan& plan,
                                                       const PatchModel& extent);

}  // namespace relief
