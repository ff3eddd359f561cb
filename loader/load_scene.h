// Reads the models of a scene, in the forms that the engines of its views draw.
#pragma once

#include <functional>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "common/scene/scene.h"
#include "loader/loaded_scene.h"
#include "loader/scene_plan.h"
#include "preprocess/texture/acquisition/acquisition.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/render.h"

namespace relief {

/// Which engines draw the scene.
struct EngineNeeds {
  bool patches = false;  ///< onepass, multipass
  bool ewa = false;
  bool raytrace = false;
};

/// Returns the views to draw of a scene whose bounds are known.
using ViewsOf = std::function<Result<std::vector<RenderSettings>>(const PatchModel& extent)>;

/// Reads the models and puts them in their positions. Reads a file that several of them name once.
/// Converts a scan or mesh with the default options where an engine draws its patches: `onepass`,
/// `multipass`, and `raytrace` if it has no triangles. `raytrace` takes its triangles, `ewa` its
/// points as they are. `textures`: of scans and meshes. Of a patch file with tiles only what
/// `views` show is read (renderer/view/patches_in_view.h); everything is read without `views`, and
/// for `raytrace` and `ewa`.
Result<LoadedScene> load_models(const std::vector<SceneModel>& models,
                                const TextureChoice& textures, EngineNeeds needs,
                                Progress& progress, const ViewsOf& views = {});

struct LoadOptions {
  TextureChoice textures;  ///< of scans and meshes
  /// How `ewa` makes splats of a mesh for which `textures` names an image. The cutoff is that of
  /// the view's settings, whatever is said here.
  AcquireOptions acquisition;
};

/// Loads what the views of a plan show. The views' settings follow by render_settings_of
/// (loader/view_settings.h), with the scene's patches for the extent.
Result<LoadedScene> load_scene(const ScenePlan& plan, const LoadOptions& options,
                               Progress& progress);

}  // namespace relief
