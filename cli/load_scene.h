// The models of a scene in memory, in the forms that its views' engines draw.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "common/scene/scene.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/render.h"

namespace relief::cli {

/// Which engines draw the scene.
struct EngineNeeds {
  bool patches = false;  ///< onepass, multipass
  bool ewa = false;
  bool raytrace = false;
};

struct LoadedScene {
  /// All models' patches, if an engine takes them; the bounds are there in any case, and the same
  /// whatever the engines are, so that cameras stand at the same place.
  PatchModel patches;
  std::optional<TriangleMesh> mesh;
  std::optional<SplatCloud> splats;
  bool mesh_is_input = false;  ///< all triangles of the mesh are faces of the files

  [[nodiscard]] RenderModel forms() const {
    RenderModel forms = RenderModel::of(patches);
    if (mesh) forms.add(*mesh);
    if (splats) forms.add(*splats);
    return forms;
  }
};

/// The pictures that are to be made of a scene, once it is known where it is.
using ViewsOf = std::function<Result<std::vector<RenderSettings>>(const PatchModel& extent)>;

/// Reads the models and puts them in their places. A file that several of them name is read once. A
/// scan or mesh is converted with the default options where an engine draws its patches: `onepass`,
/// `multipass`, and `raytrace` where it has no triangles; `raytrace` takes its triangles, `ewa` its
/// points as they are. `textures`: of scans and meshes. Of patch files with tiles only what
/// `pictures` show is read (renderer/patches_in_view.h); without these, or where rays are followed
/// or points splatted, all is.
Result<LoadedScene> load_scene(const std::vector<SceneModel>& models, const TextureChoice& textures,
                               EngineNeeds needs, Progress& progress, const ViewsOf& pictures = {});

}  // namespace relief::cli
