#include "loader/load_volume.h"

#include <algorithm>
#include <utility>

#include "common/volume/move.h"
#include "renderer/volume/extent.h"

namespace relief {

bool has_kernels(const std::filesystem::path& path, const VolumeReadOptions& options) {
  return is_volume(path, options);
}

Result<bool> has_kernels(const std::vector<SceneModel>& models, const VolumeReadOptions& options) {
  const auto count = std::count_if(models.begin(), models.end(), [&](const SceneModel& model) {
    return has_kernels(model.file, options);
  });
  if (count == 0) return false;
  if (models.size() == 1) return true;
  return make_error(
      "{}: a volume or a scene of 3D Gaussians is drawn by itself; the scene has {} models",
      models.front().file.string(), models.size());
}

void choose_volume_engine(ScenePlan& plan, const VolumeReadOptions& options) {
  const bool is_volume =
      std::any_of(plan.models.begin(), plan.models.end(),
                  [&](const SceneModel& model) { return has_kernels(model.file, options); });
  if (!is_volume) return;
  for (PlannedView& view : plan.views) {
    if (!view.settings.engine) view.settings.engine = "volume";
  }
}

Result<LoadedScene> load_kernels(const std::vector<SceneModel>& models,
                                 const VolumeReadOptions& options, Progress& progress) {
  const SceneModel& model = models.front();
  LoadedScene scene;
  RELIEF_TRY_ASSIGN(auto volume, read_volume(model.file, options, progress));
  move_volume(volume, model.transform);
  set_extent(scene.patches, extent_of(volume));
  scene.patches.stance = volume.stance;
  scene.volume = std::move(volume);
  return scene;
}

}  // namespace relief
