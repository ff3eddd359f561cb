// Assembles the models of a scene, each in its position.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "common/patch.h"
#include "common/scene/scene.h"
#include "loader/scene/loaded_scene.h"

namespace relief {

/// A file in the forms that the scene needs. The patches always have the bounds.
struct LoadedFile {
  PatchModel patches;
  std::optional<PatchRun> run;  ///< once `patches` have been moved into a scene of several models
  std::optional<TriangleMesh> mesh;
  std::optional<SplatCloud> splats;
  std::optional<VolumePart> volume;  ///< then there is nothing else
  SectionBytes read;                 ///< of a patch file
  bool is_mesh = false;              ///< the file has faces, or its patches are of some
  bool has_faces = false;            ///< the mesh is the file's own
};

/// One model of a scene: a file in a position.
struct FileUse {
  Transform where;
  std::size_t model = 0;          ///< its index in the scene's models
  std::uint8_t material = 0;      ///< its index in distinct_materials
  bool is_last = true;            ///< no later model uses the file
  std::optional<bool> is_closed;  ///< overrides the file's own flag
};

/// Assembles models. A scene's only model is moved to its position. Of several models, the patches
/// of a file are kept once, with one instance for each use.
class SceneAssembler {
 public:
  explicit SceneAssembler(bool several) : several_(several) {}

  /// Adds a model. The last use of a file takes its forms; earlier ones copy them.
  Status add(LoadedFile& file, const FileUse& use);

  /// Adds what cameras see of a thing that is not added itself.
  void add_extent(const PatchModel& extent);

  LoadedScene take() { return std::move(scene_); }

 private:
  Status add_volume(LoadedFile& file, const FileUse& use);
  Status move_model(PatchModel& model, const FileUse& use);
  Status add_model_instance(LoadedFile& file, const FileUse& use);

  bool several_ = false;
  LoadedScene scene_;
  std::uint32_t patches_ = 0;  ///< of the models so far
};

/// Calls `add(path, use)` for each model, and adds the file's name to an error.
template <class Add>
Status for_each_use(const std::vector<SceneModel>& models, const Add& add) {
  std::map<std::filesystem::path, std::size_t> uses;
  for (const SceneModel& model : models) ++uses[model.file];
  const std::vector<MaterialOverrides> materials = distinct_materials(models);
  for (std::size_t k = 0; k < models.size(); ++k) {
    const SceneModel& model = models[k];
    const auto material =
        std::find(materials.begin(), materials.end(), model.material) - materials.begin();
    const FileUse use{model.transform, k, static_cast<std::uint8_t>(material),
                      --uses[model.file] == 0, model.is_closed};
    const Status added = add(model.file, use);
    if (!added) return make_error("{}: {}", model.file.string(), added.error().message);
  }
  return {};
}

}  // namespace relief
