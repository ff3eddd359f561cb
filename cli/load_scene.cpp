#include "cli/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "cli/console.h"
#include "cli/load.h"
#include "cli/options/paths.h"
#include "cli/place_models.h"
#include "common/patch_file/patch_tree.h"
#include "common/transform.h"
#include "preprocess/convert.h"
#include "renderer/engines/ewa/splats_of_samples.h"
#include "renderer/geometry/mesh_of_patches.h"
#include "renderer/geometry/mesh_of_points.h"
#include "renderer/view/patches_in_view.h"

namespace relief::cli {
namespace {

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

/// Reads what the pictures show of the trees.
Status load_trees(const std::vector<SceneModel>& models, const TreeFiles& trees,
                  const PicturesOf& pictures_of, LoadedFiles& loaded, Progress& progress) {
  const auto extent = extent_of(models, loaded, trees);
  if (!extent) return extent.error();
  const auto pictures = pictures_of(*extent);
  if (!pictures) return pictures.error();
  for (const auto& [path, tree] : trees) {
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
