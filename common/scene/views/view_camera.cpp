#include "common/scene/views/view_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "common/extremes.h"
#include "common/scene/views/framing.h"

namespace relief {
namespace {

constexpr double kDefaultFieldOfView = 45.0;

constexpr Orbit kFlatOrbit{30.0, 35.0, 0.0};
constexpr Orbit kBodyOrbit{25.0, 15.0, 0.0};

glm::dvec3 middle_of(const PatchModel& model) {
  return 0.5 * (model.bounds.min + model.bounds.max);
}

/// A model without size or patches has no bounding sphere.
double radius_of(const PatchModel& model) {
  return model.bounding_radius > 0.0 ? model.bounding_radius : 1.0;
}

double aspect_of(const SceneSettings& settings) {
  const ImageSize size = settings.size.value_or(ImageSize{});
  return static_cast<double>(size.width) / size.height;
}

Camera camera_on_orbit(const SceneSettings& settings, const PatchModel& model, const Orbit& orbit) {
  const double aspect = aspect_of(settings);
  Camera camera = orbit_camera(middle_of(model), radius_of(model), orbit,
                               settings.fov_degrees.value_or(kDefaultFieldOfView), aspect,
                               stance_of(settings, model));
  if (!settings.orthographic) return camera;
  const auto points = points_to_frame(model);
  camera.orthographic_height =
      settings.orthographic->height.value_or(framing_height(camera, points, aspect));
  return camera;
}

Result<Camera> camera_at_eye(const SceneSettings& settings, const PatchModel& model) {
  Camera camera{*settings.eye, settings.target.value_or(middle_of(model)),
                settings.up.value_or(model.stance.up),
                settings.fov_degrees.value_or(kDefaultFieldOfView)};
  if (camera.eye == camera.target) {
    return Error{settings.target ? "the eye is where its target is"
                                 : "the eye is in the middle of the model, which it looks at "
                                   "unless a target is named"};
  }
  if (settings.orthographic) {
    camera.orthographic_height = settings.orthographic->height.value_or(
        framing_height(camera, points_to_frame(model), aspect_of(settings)));
  }
  return camera;
}

/// Where a model is looked at from unless a camera is named: a sensor's frame from the sensor; what
/// is flat, such as terrain, obliquely from above; anything else from the front, a little from the
/// side and above.
Orbit first_orbit(const SceneSettings& settings, const PatchModel& model) {
  const Stance stance = stance_of(settings, model);
  if (stance.is_from_sensor) return {};
  return is_flat(model, stance) ? kFlatOrbit : kBodyOrbit;
}

}  // namespace

Stance stance_of(const SceneSettings& settings, const PatchModel& model) {
  return settings.eye ? model.stance : stance_of(settings.up, model.stance);
}

bool is_flat(const PatchModel& model, const Stance& stance) {
  if (stance.is_from_sensor) return false;
  const std::vector<glm::dvec3> points = points_to_frame(model);
  const auto length_along = [&points](const glm::dvec3& axis) {
    const auto [low, high] =
        std::ranges::minmax(points, {}, [&axis](const glm::dvec3& p) { return glm::dot(p, axis); });
    return glm::dot(high - low, axis);
  };
  const glm::dvec3 side = glm::cross(stance.up, stance.front);
  const double level = std::min(length_along(side), length_along(stance.front));
  return length_along(stance.up) <= kFlatHeight * level;
}

std::vector<glm::dvec3> points_to_frame(const PatchModel& model) {
  if (!model.extremes.empty()) return model.extremes;
  std::vector<glm::dvec3> corners = corners_of(model.bounds);
  // A model without patches is nowhere.
  return corners.empty() ? std::vector<glm::dvec3>(1, glm::dvec3(0.0)) : corners;
}

SceneSettings with_camera(SceneSettings settings, const Camera& camera) {
  settings.orbit.reset();
  settings.eye = camera.eye;
  settings.target = camera.target;
  settings.up = camera.up;
  settings.fov_degrees.reset();
  settings.orthographic.reset();
  if (camera.is_orthographic())
    settings.orthographic = OrthographicSize{camera.orthographic_height};
  else
    settings.fov_degrees = camera.vertical_fov_degrees;
  return settings;
}

std::vector<SceneSettings> film_frames(const SceneSettings& settings, const PatchModel& model,
                                       std::size_t count) {
  const std::vector<glm::dvec3> points = points_to_frame(model);
  const double aspect = aspect_of(settings);
  const bool fits_height = settings.orthographic && !settings.orthographic->height;
  std::vector<SceneSettings> frames(count, settings);
  double distance = 0.0;
  double height = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    Orbit& orbit =
        frames[i].orbit.emplace(settings.orbit ? *settings.orbit : first_orbit(settings, model));
    orbit.azimuth_degrees += 360.0 * static_cast<double>(i) / static_cast<double>(count);
    const Camera camera =
        rolled(camera_on_orbit(settings, model, orbit), settings.roll_degrees.value_or(0.0));
    distance = std::max(distance, framing_distance(camera, points, aspect));
    height = std::max(height, framing_height(camera, points, aspect));
  }
  for (SceneSettings& frame : frames) {
    double& radii = frame.orbit->distance_in_radii;
    if (!(radii > 0.0)) radii = distance / radius_of(model);
    if (fits_height) frame.orthographic = OrthographicSize{height};
  }
  return frames;
}

Result<Camera> camera_for(const SceneSettings& settings, const PatchModel& model) {
  Camera camera;
  const double roll = settings.roll_degrees.value_or(0.0);
  if (settings.eye) {
    RELIEF_TRY_ASSIGN(camera, camera_at_eye(settings, model));
    camera = rolled(camera, roll);
  } else {
    const Orbit orbit = settings.orbit ? *settings.orbit : first_orbit(settings, model);
    camera = rolled(camera_on_orbit(settings, model, orbit), roll);
    if (!(orbit.distance_in_radii > 0.0)) {
      const bool fits_height = !settings.orthographic || !settings.orthographic->height;
      camera = framed(camera, points_to_frame(model), aspect_of(settings), fits_height);
    }
  }
  return zoomed(camera, settings.zoom.value_or(1.0));
}

}  // namespace relief
