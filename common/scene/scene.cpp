#include "common/scene/scene.h"

#include <algorithm>
#include <utility>

namespace relief {
namespace {

template <class T>
void take(std::optional<T>& to, const std::optional<T>& from) {
  if (from) to = from;
}

constexpr double kDefaultFieldOfView = 45.0;

}  // namespace

std::vector<MaterialOverrides> distinct_materials(const std::vector<SceneModel>& models) {
  std::vector<MaterialOverrides> distinct;
  for (const SceneModel& model : models) {
    if (std::find(distinct.begin(), distinct.end(), model.material) == distinct.end())
      distinct.push_back(model.material);
  }
  return distinct;
}

SceneSettings overlay(SceneSettings base, const SceneSettings& over) {
  if (over.orbit) base.eye.reset();
  if (over.eye) base.orbit.reset();
  if (over.fov_degrees) base.orthographic.reset();
  if (over.orthographic) base.fov_degrees.reset();
  take(base.size, over.size);
  take(base.orbit, over.orbit);
  take(base.eye, over.eye);
  take(base.target, over.target);
  take(base.up, over.up);
  take(base.fov_degrees, over.fov_degrees);
  take(base.orthographic, over.orthographic);
  take(base.engine, over.engine);
  static_cast<MaterialOverrides&>(base) = overlay_material(base, over);
  take(base.lights, over.lights);
  take(base.ambient, over.ambient);
  take(base.environment, over.environment);
  take(base.background, over.background);
  take(base.exposure, over.exposure);
  take(base.outputs, over.outputs);
  base.options = overlay_options(std::move(base.options), over.options);
  return base;
}

Result<Camera> camera_for(const SceneSettings& settings, const PatchModel& model) {
  const glm::dvec3 centre = 0.5 * (model.bounds.min + model.bounds.max);
  const double fov = settings.fov_degrees.value_or(kDefaultFieldOfView);
  const ImageSize size = settings.size.value_or(ImageSize{});
  const double aspect = static_cast<double>(size.width) / size.height;
  // A model without size or patches has no bounding sphere.
  const double radius = model.bounding_radius > 0.0 ? model.bounding_radius : 1.0;
  const auto projected = [&](Camera camera) {
    if (settings.orthographic) {
      camera.orthographic_height =
          settings.orthographic->height.value_or(fitting_height(camera, centre, radius, aspect));
    }
    return camera;
  };
  if (settings.eye) {
    const Camera camera{*settings.eye, settings.target.value_or(centre),
                        settings.up.value_or(glm::dvec3(0.0, 1.0, 0.0)), fov};
    if (camera.eye != camera.target) return projected(camera);
    return Error{settings.target ? "the eye is where its target is"
                                 : "the eye is in the middle of the model, which it looks at "
                                   "unless a target is named"};
  }
  return projected(orbit_camera(centre, radius, settings.orbit.value_or(Orbit{}), fov, aspect));
}

}  // namespace relief
