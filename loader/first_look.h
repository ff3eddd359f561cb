// What a picture looks like where its user asked for nothing.
#pragma once

#include "loader/loaded_scene.h"
#include "loader/scene_plan.h"
#include "renderer/settings.h"

namespace relief {

/// Samples a pixel of a picture by an engine on OpenGL, unless its frames are to be timed.
inline constexpr int kPictureSamples = 4;

/// Completes the settings of a view with what its plan leaves open: a background on which dark and
/// light scans both show; kPictureSamples samples a pixel; the stored colours of points that have
/// some, which are photographs mostly and lit already, and light on anything else.
void complete_look(const PlannedView& view, const LoadedScene& scene, RenderSettings& settings);

}  // namespace relief
