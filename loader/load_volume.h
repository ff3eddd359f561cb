// Volumes and scenes of 3D Gaussians in memory.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "common/scene/scene.h"
#include "loader/loaded_scene.h"
#include "loader/scene_plan.h"
#include "preprocess/readers/selection.h"
#include "preprocess/volumes/read_volume.h"

namespace relief {

/// The engine that draws volumes and 3D Gaussians where none is named. On OpenGL without a GPU they
/// take as long or longer (docs/decisions/0119).
inline constexpr const char* kVolumeEngine = "volume-reference";

/// Whether a file is drawn as kernels: a volume, 3D Gaussians, or a scan if the options name a
/// scalar of its points. Reads at most its header; a file that can't be read is neither.
[[nodiscard]] bool has_kernels(const std::filesystem::path& path, const VolumeReadOptions& options);

/// Whether all models of a scene are such files, or none is. Fails if only some are.
Result<bool> has_kernels(const std::vector<SceneModel>& models, const VolumeReadOptions& options);

/// Gives the views that name no engine the one that draws such models.
void choose_volume_engine(ScenePlan& plan, const VolumeReadOptions& options);

/// Reads the plan's only model, a volume or Gaussians, with the extent that cameras see. `read`:
/// how a scan is read whose points are the nodes. Fails if an engine of its views draws neither.
Result<LoadedScene> load_kernels(const ScenePlan& plan, const VolumeReadOptions& options,
                                 const ReadOptions& read, std::span<const EngineEntry> among,
                                 Progress& progress);

}  // namespace relief
