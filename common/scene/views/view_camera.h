// The camera that settings ask for, and that of a picture for which nothing is asked.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "common/stance.h"

namespace relief {

/// The camera of an image of the model, of which only the extent and the stance are used.
///
/// Without orbit and eye, a sensor's frame is seen from the sensor, flat terrain obliquely from
/// above, and anything else from the front. That and an orbit without a distance are framed: the
/// model's extreme points, or without those the corners of its bounds, take most of the image.
/// An orbit with a distance, and an eye without a target, look at the middle of the bounds. An
/// orthographic camera without a height sees the model just whole. `roll_degrees` and `zoom` come
/// last. Fails, with a clause, if the eye is where it looks.
Result<Camera> camera_for(const SceneSettings& settings, const PatchModel& model);

/// How the model stands: as `settings` say by their up direction, unless that is an eye's, which a
/// camera that rolls has, too.
[[nodiscard]] Stance stance_of(const SceneSettings& settings, const PatchModel& model);

/// Whether a model lies flat, as terrain does: it is far wider and deeper than high. Never what is
/// seen from one sensor.
[[nodiscard]] bool is_flat(const PatchModel& model, const Stance& stance);

/// The points of a model that an image shows whole: its extreme points, or without those the
/// corners of its bounds, or the origin. Not empty.
[[nodiscard]] std::vector<glm::dvec3> points_to_frame(const PatchModel& model);

/// The same settings with a camera, in place of their orbit, eye or view. Roll and zoom stay.
[[nodiscard]] SceneSettings with_camera(SceneSettings settings, const Camera& camera);

/// The settings of each frame of a film in which the camera goes once around the model, at the
/// elevation that `settings` have. All frames look at the middle of the bounds from one distance,
/// from which the model is whole in each of them, unless `settings` name the distance.
[[nodiscard]] std::vector<SceneSettings> film_frames(const SceneSettings& settings,
                                                     const PatchModel& model, std::size_t count);

}  // namespace relief
