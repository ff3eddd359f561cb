// Volumes and scenes of 3D Gaussians in memory.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "common/scene/scene.h"
#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "preprocess/readers/selection.h"
#include "preprocess/volumes/read_volume.h"

namespace relief {

/// The engine that draws volumes and 3D Gaussians where none is named.
inline constexpr const char* kVolumeEngine = "volume";

/// Whether a file is drawn as kernels: a volume, 3D Gaussians, or a scan if the options name a
/// scalar of its points. Reads at most its header; a file that can't be read is neither.
[[nodiscard]] bool has_kernels(const std::filesystem::path& path, const VolumeReadOptions& options);

/// Whether a model of a scene is such a file. Its own layout goes before that of the options.
[[nodiscard]] bool has_kernels(const SceneModel& model, const VolumeReadOptions& options);

/// Whether some model of a scene is such a file.
[[nodiscard]] bool has_kernels(const std::vector<SceneModel>& models,
                               const VolumeReadOptions& options);

/// Whether some model that the user's file shows is such a file: the file itself, or one that a
/// scene names. A scene that can't be read has none.
[[nodiscard]] bool shows_kernels(const std::filesystem::path& input,
                                 const VolumeReadOptions& options);

/// Gives the views that name no engine the one that draws such models.
void choose_volume_engine(ScenePlan& plan, const VolumeReadOptions& options);

/// Gives the views an engine for a window: volumes and 3D Gaussians the one on OpenGL that draws
/// them, and all else another than that. Of files that are opened one after the other each has the
/// look of the one before.
void fit_engine(ScenePlan& plan, const VolumeReadOptions& options);

/// Fails unless the engines of all views draw kernels, which the plan's models have, and each model
/// has only what its file can use: a layout and options of its own if it is a volume or Gaussians.
Status check_kernels(const ScenePlan& plan, const VolumeReadOptions& options,
                     std::span<const EngineEntry> among);

/// Reads a volume or Gaussians, which stand where the file has them. `read`: how a scan is read
/// whose points are the nodes.
Result<VolumePart> load_part(const SceneModel& model, const VolumeReadOptions& options,
                             const ReadOptions& read, Progress& progress);

/// Puts them in their position. Fails, with a clause, as move_gaussians() does.
Status move_part(VolumePart& part, const Transform& transform);

/// What cameras see of them once they are moved so: a model without patches.
[[nodiscard]] PatchModel extent_of(const VolumePart& part, const Transform& transform);

/// Reads the plan's only model, a volume or Gaussians, with the extent that cameras see. `read`: as
/// load_part().
Result<LoadedScene> load_kernels(const ScenePlan& plan, const VolumeReadOptions& options,
                                 const ReadOptions& read, Progress& progress);

}  // namespace relief
