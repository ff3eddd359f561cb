#include "common/scene/scene.h"

#include <algorithm>
#include <utility>

namespace relief {
namespace {

template <class T>
void take(std::optional<T>& to, const std::optional<T>& from) {
  if (from) to = from;
}

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
  take(base.roll_degrees, over.roll_degrees);
  take(base.zoom, over.zoom);
  take(base.fov_degrees, over.fov_degrees);
  take(base.orthographic, over.orthographic);
  take(base.engine, over.engine);
  static_cast<MaterialOverrides&>(base) = overlay_material(base, over);
  take(base.lights, over.lights);
  take(base.ambient, over.ambient);
  take(base.environment, over.environment);
  take(base.environment_rotation_degrees, over.environment_rotation_degrees);
  take(base.background, over.background);
  take(base.exposure, over.exposure);
  take(base.eye_dome, over.eye_dome);
  take(base.outputs, over.outputs);
  base.options = overlay_options(std::move(base.options), over.options);
  return base;
}

}  // namespace relief
