#include "loader/load_volume.h"

#include <algorithm>
#include <utility>

#include "common/patch_file/patch_file.h"
#include "common/volume/move.h"
#include "loader/view_settings.h"
#include "preprocess/gaussians/read_gaussians.h"
#include "preprocess/points/point_volume.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/read_points.h"
#include "renderer/volume/extent.h"

namespace relief {
namespace {

bool draws_kernels(const EngineEntry& engine) {
  return std::find(engine.forms.begin(), engine.forms.end(), ModelForm::Volume) !=
         engine.forms.end();
}

/// Reads a volume, or a scan whose points are the nodes of one.
Result<ScalarVolume> read_nodes(const std::filesystem::path& path, const VolumeReadOptions& options,
                                const ReadOptions& read, Progress& progress) {
  if (!options.scalar) return read_volume(path, options, progress);
  if (has_kernels(path, {}) || names_patch_file(path) || is_raster(path, read.format)) {
    return make_error("{}: has no points whose scalar '{}' could be a volume; leave the scalar out",
                      path.string(), *options.scalar);
  }
  ReadOptions with_scalar = read;
  with_scalar.scalars = {false, {*options.scalar}};
  RELIEF_TRY_ASSIGN(auto scan, read_points(path, progress, with_scalar));
  auto volume = volume_of_points(std::move(scan.points), *options.scalar, progress);
  if (!volume) return make_error("{}: {}", path.string(), volume.error().message);
  return volume;
}

}  // namespace

bool has_kernels(const std::filesystem::path& path, const VolumeReadOptions& options) {
  if (options.scalar || is_volume(path, options)) return true;
  const auto found = is_gaussians(path);
  return found && *found;
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
    if (!view.settings.engine) view.settings.engine = kVolumeEngine;
  }
}

Result<LoadedScene> load_kernels(const ScenePlan& plan, const VolumeReadOptions& options,
                                 const ReadOptions& read, std::span<const EngineEntry> among,
                                 Progress& progress) {
  const SceneModel& model = plan.models.front();
  for (const PlannedView& view : plan.views) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_of(view, among));
    if (!draws_kernels(*engine)) {
      return make_error(
          "{}: is a volume or a scene of 3D Gaussians, which engine {} can't draw; `relief render` "
          "draws it with engine volume or volume-reference",
          model.file.string(), engine->name);
    }
  }
  LoadedScene scene;
  if (!options.scalar && !is_volume(model.file, options)) {
    RELIEF_TRY_ASSIGN(auto gaussians, read_gaussians(model.file, progress));
    if (const Status moved = move_gaussians(gaussians, model.transform); !moved)
      return make_error("{}: {}", model.file.string(), moved.error().message);
    set_extent(scene.patches, extent_of(gaussians));
    scene.patches.stance = gaussians.stance;
    scene.gaussians = std::move(gaussians);
    return scene;
  }
  RELIEF_TRY_ASSIGN(auto volume, read_nodes(model.file, options, read, progress));
  move_volume(volume, model.transform);
  set_extent(scene.patches, extent_of(volume));
  scene.patches.stance = volume.stance;
  scene.volume = std::move(volume);
  return scene;
}

}  // namespace relief
