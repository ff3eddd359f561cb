// What a picture looks like where its user asked for nothing.
#pragma once

#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "renderer/settings.h"

namespace relief {

/// Samples a pixel of a picture by an engine on OpenGL, unless its frames are to be timed.
inline constexpr int kPictureSamples = 4;

/// What decides whether a view that names no material shows colours as they are stored.
struct ShownColours {
  bool are_there = false;
  bool stand_for_numbers = false;  ///< LoadOptions::colour_by
  bool are_on_faces = false;       ///< LoadedScene::has_faces
};

/// Returns whether a view is unlit although its plan does not say so.
[[nodiscard]] bool is_unlit_at_first(const SceneSettings& planned, const ShownColours& colours);

/// Whether a view names its samples a pixel. Those of complete_look() need no finer tiles of patch
/// files than one: half as far apart they take 2.5 times as long, for 3 dB.
[[nodiscard]] bool asks_for_samples(const SceneSettings& planned);

/// Completes the settings of a view with what its plan leaves open: a background on which dark and
/// light scans both show; kPictureSamples samples a pixel; the stored colours of points that have
/// some, which are photographs mostly and lit already, and light on anything else.
void complete_look(const PlannedView& view, const LoadedScene& scene, RenderSettings& settings);

}  // namespace relief
