#include "cli/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "cli/console.h"
#include "cli/load.h"
#include "cli/paths.h"
#include "common/patch_tree.h"
#include "common/transform.h"
#include "preprocess/convert.h"
#include "renderer/append.h"
#include "renderer/engines/ewa/splats_of_samples.h"
#include "renderer/mesh_of_patches.h"
#include "renderer/mesh_of_points.h"
#include "renderer/patches_in_view.h"

namespace relief::cli {
namespace {

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

/// Whether engines draw something else of the scene than patches. If not, they make what they need
/// of the patches themselves.
struct Forms {
  bool mesh = false;
  bool splats = false;
};

Status add_mesh_of_patches(LoadedFile& file, const std::filesystem::path& path) {
  auto mesh = mesh_of_patches(file.patches);
  if (!mesh) return make_error("{}: {}", path.string(), mesh.error().message);
  file.mesh = std::move(*mesh);
  return {};
}

Result<LoadedFile> load_patch_file(const std::filesystem::path& path, Forms forms,
                                   Progress& progress) {
  auto model = load_model(path, progress);
  if (!model) return model.error();
  LoadedFile file;
  file.patches = std::move(*model);
  if (forms.mesh) {
    const Status made = add_mesh_of_patches(file, path);
    if (!made) return made.error();
  }
  if (forms.splats) file.splats = ewa::splats_of_samples(file.patches);
  return file;
}

Result<LoadedFile> load_scan(const std::filesystem::path& path, const TextureChoice& textures,
                             EngineNeeds needs, Progress& progress) {
  auto scan = load_mesh(path, textures, progress);
  if (!scan) return scan.error();
  LoadedFile file;
  file.patches.bounds = bounds_of(scan->points.positions);
  file.patches.bounding_radius = bounding_radius(scan->points.positions, file.patches.bounds);
  const bool has_triangles = !scan->points.triangles.empty();
  if (needs.raytrace && has_triangles) file.mesh = mesh_of_points(scan->points);
  file.has_faces = file.mesh.has_value();
  if (needs.ewa) {
    auto splats = splats_of_points(scan->points, progress);
    if (!splats) return make_error("{}: {}", path.string(), splats.error().message);
    file.splats = std::move(*splats);
  }
  const bool traces_patches = needs.raytrace && !has_triangles;
  if (!needs.patches && !traces_patches) return file;
  auto converted = convert(std::move(scan->points), {}, progress);
  if (!converted) return make_error("{}: {}", path.string(), converted.error().message);
  file.patches = std::move(converted->model);
  if (!traces_patches) return file;
  const Status made = add_mesh_of_patches(file, path);
  if (!made) return made.error();
  return file;
}

/// One model of a scene.
struct Use {
  Transform where;
  std::uint8_t material = 0;      ///< its number among materials_said
  bool is_last = true;            ///< of its file
  std::optional<bool> is_closed;  ///< instead of what is known of the file
};

/// Moves a file's triangles and points to their place, gives them their material and appends them.
/// `patches_before`: how many patches the models before have.
Status place_forms(LoadedScene& scene, LoadedFile file, const Use& use,
                   std::uint32_t patches_before) {
  if (file.splats) {
    transform(*file.splats, use.where);
    if (use.material != 0)
      file.splats->materials.assign(file.splats->positions.size(), use.material);
    if (!scene.splats) scene.splats.emplace();
    append(*scene.splats, std::move(*file.splats), patches_before);
  }
  if (!file.mesh) return {};
  scene.mesh_is_input = file.has_faces && (!scene.mesh || scene.mesh_is_input);
  transform(*file.mesh, use.where);
  if (use.material != 0) file.mesh->materials.assign(file.mesh->positions.size(), use.material);
  if (!scene.mesh) scene.mesh.emplace();
  return append(*scene.mesh, std::move(*file.mesh), patches_before);
}

/// Puts models in their places. The only one of a scene is moved there; of several the patches are
/// kept once, wherever they stand.
class Placer {
 public:
  explicit Placer(bool several) : several_(several) {}

  Status place(LoadedFile& file, const Use& use) {
    const std::uint32_t patches_before = patches_;
    Status placed = several_ ? add_place(file, use) : move_there(file.patches, use);
    if (!placed) return placed;
    return place_forms(scene_, use.is_last ? std::move(file) : LoadedFile(file), use,
                       patches_before);
  }

  LoadedScene take() { return std::move(scene_); }

 private:
  Status move_there(PatchModel& model, const Use& use) {
    for (Patch& patch : model.patches) patch.material = use.material;
    model.is_closed = use.is_closed.value_or(model.is_closed);
    patches_ += static_cast<std::uint32_t>(model.patches.size());
    Status moved = transform_model(model, use.where);
    if (moved) append_model(scene_.patches, std::exchange(model, {}));
    return moved;
  }

  Status add_place(LoadedFile& file, const Use& use) {
    PatchModel& model = file.patches;
    if (!file.run) {
      std::vector<Patch>& all = scene_.patches.patches;
      file.run = {static_cast<std::uint32_t>(all.size()),
                  static_cast<std::uint32_t>(model.patches.size())};
      std::move(model.patches.begin(), model.patches.end(), std::back_inserter(all));
      model = without_patches(model);
    }
    const auto [first, count] = *file.run;
    patches_ += count;
    PatchModel extent = model;
    extent.is_closed = use.is_closed.value_or(model.is_closed);
    return add_placement(scene_.patches, {first, count, use.where, use.material}, extent);
  }

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

using LoadedFiles = std::map<std::filesystem::path, LoadedFile>;
using TreeFiles = std::map<std::filesystem::path, PatchTree>;

/// The patch files that have tiles, opened.
Result<TreeFiles> open_trees(const std::vector<SceneModel>& models) {
  TreeFiles trees;
  for (const SceneModel& model : models) {
    if (ending(model.file) != ".relief" || trees.find(model.file) != trees.end()) continue;
    auto tree = PatchTree::open(model.file);
    if (!tree) return tree.error();
    if (tree->tiles().size() > 1) trees.emplace(model.file, std::move(*tree));
  }
  return trees;
}

/// The scene's bounds, of which no patch of the trees has been read.
Result<PatchModel> extent_of(const std::vector<SceneModel>& models, const LoadedFiles& loaded,
                             const TreeFiles& trees) {
  Placer placer(models.size() > 1);
  const Status placed = place_models(models, [&](const auto& path, const Use& use) {
    const auto tree = trees.find(path);
    LoadedFile file;
    file.patches =
        tree == trees.end() ? without_patches(loaded.at(path).patches) : tree->second.extent();
    return placer.place(file, use);
  });
  if (!placed) return placed.error();
  return placer.take().patches;
}

/// Reads what the pictures show of the trees; what is read at all if nobody knows that.
Status load_trees(const std::vector<SceneModel>& models, const TreeFiles& trees,
                  const PicturesOf& pictures_of, LoadedFiles& loaded, Progress& progress) {
  const auto extent = extent_of(models, loaded, trees);
  if (!extent) return extent.error();
  const auto pictures = pictures_of(*extent);
  if (!pictures) return pictures.error();
  const bool choose = std::all_of(pictures->begin(), pictures->end(), can_choose_patches);
  for (const auto& [path, tree] : trees) {
    if (!choose) {
      auto model = load_model(path, progress);
      if (!model) return model.error();
      loaded[path].patches = std::move(*model);
      continue;
    }
    std::vector<Transform> places;
    for (const SceneModel& model : models) {
      if (model.file == path) places.push_back(model.transform);
    }
    auto read = read_in_view(tree, onlookers_of(*pictures, places, *extent), progress);
    if (!read) return read.error();
    note(fmt::format("{}: {} of {} tiles are read for this, {} patches with {} samples",
                     path.string(), read->tiles, tree.tiles().size(), read->model.patches.size(),
                     read->samples));
    loaded[path].patches = std::move(read->model);
  }
  return {};
}

}  // namespace

Result<LoadedScene> load_scene(const std::vector<SceneModel>& models, const TextureChoice& textures,
                               EngineNeeds needs, Progress& progress, const PicturesOf& pictures) {
  const bool has_scans = std::any_of(models.begin(), models.end(), [](const SceneModel& model) {
    return ending(model.file) != ".relief";
  });
  const Forms forms{needs.raytrace && has_scans, needs.ewa && has_scans};
  // What follows rays or splats points takes all patches.
  const bool may_choose = pictures && !needs.raytrace && !needs.ewa;
  const auto trees = may_choose ? open_trees(models) : Result(TreeFiles());
  if (!trees) return trees.error();

  LoadedFiles loaded;
  for (const SceneModel& model : models) {
    if (loaded.find(model.file) != loaded.end() || trees->find(model.file) != trees->end())
      continue;
    auto file = ending(model.file) == ".relief" ? load_patch_file(model.file, forms, progress)
                                                : load_scan(model.file, textures, needs, progress);
    if (!file) return file.error();
    loaded.emplace(model.file, std::move(*file));
  }
  if (!trees->empty()) {
    const Status read = load_trees(models, *trees, pictures, loaded, progress);
    if (!read) return read.error();
  }
  Placer placer(models.size() > 1);
  const Status placed = place_models(
      models, [&](const auto& path, const Use& use) { return placer.place(loaded.at(path), use); });
  if (!placed) return placed.error();
  return placer.take();
}

}  // namespace relief::cli
