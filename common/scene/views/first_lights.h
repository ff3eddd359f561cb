// The lights of an image for which none are asked.
#pragma once

#include "common/patch.h"
#include "common/scene/light.h"
#include "common/scene/scene.h"

namespace relief {

/// The lights of a lit image of one model that names none. On terrain, which is what lies flat and
/// is open, a sun in the west-north-west, with the light of sky and ground: maps are shaded so, and
/// from the camera slopes look alike. On anything else three lights fixed to the camera (none in
/// the list). `settings` may name the ambient light and the up direction. Only the model's extent,
/// its stance and `is_closed` are used.
[[nodiscard]] Lights first_lights(const SceneSettings& settings, const PatchModel& model);

}  // namespace relief
