// The models of a scene put in their places.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "cli/load_scene.h"
#include "common/patch.h"
#include "common/scene/scene.h"

namespace relief::cli {

/// Where a file's patches lie among a scene's.
struct PatchRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// A file in the forms that are needed of it. The patches have the bounds in any case.
struct LoadedFile {
  PatchModel patches;
  std::optional<PatchRun> run;  ///< once `patches` have been moved into a scene of several models
  std::optional<TriangleMesh> mesh;
  std::optional<SplatCloud> splats;
  bool has_faces = false;  ///< the mesh is the file's own
};

/// One model of a scene.
struct Use {
  Transform where;
  std::uint8_t material = 0;      ///< its number among materials_said
  bool is_last = true;            ///< of its file
  std::optional<bool> is_closed;  ///< instead of what is known of the file
};

/// Puts models in their places. The only one of a scene is moved there; of several the patches are
/// kept once, wherever they stand.
class Placer {
 public:
  explicit Placer(bool several) : several_(several) {}

  /// Takes the file's forms if it is their last use.
  Status place(LoadedFile& file, const Use& use);

  LoadedScene take() { return std::move(scene_); }

 private:
  Status move_there(PatchModel& model, const Use& use);
  Status add_place(LoadedFile& file, const Use& use);

  bool several_ = false;
  LoadedScene scene_;
  std::uint32_t patches_ = 0;  ///< of the models so far
};

/// Calls `place` with each model's file and use.
template <class Place>
Status place_models(const std::vector<SceneModel>& models, const Place& place) {
  std::map<std::filesystem::path, std::size_t> uses;
  for (const SceneModel& model : models) ++uses[model.file];
  const std::vector<MaterialWords> said = materials_said(models);
  for (const SceneModel& model : models) {
    const auto material = std::find(said.begin(), said.end(), model.material) - said.begin();
    const Use use{model.transform, static_cast<std::uint8_t>(material), --uses[model.file] == 0,
                  model.is_closed};
    const Status placed = place(model.file, use);
    if (!placed) return make_error("{}: {}", model.file.string(), placed.error().message);
  }
  return {};
}

}  // namespace relief::cli
