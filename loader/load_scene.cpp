#include "loader/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "common/io/extension.h"
#include "common/patch_file/patch_tree.h"
#include "common/transform.h"
#include "loader/load_files.h"
#include "loader/models/acquire_splats.h"
#include "loader/models/assemble.h"
#include "loader/models/colour_by.h"
#include "loader/models/load_volume.h"
#include "loader/models/texture_splats.h"
#include "loader/scene/audience.h"
#include "loader/scene/patch_sections.h"
#include "loader/scene/view_settings.h"
#include "preprocess/convert.h"
#include "preprocess/raster/raster.h"
#include "renderer/geometry/meshes/mesh_of_patches.h"
#include "renderer/geometry/meshes/mesh_of_points.h"
#include "renderer/geometry/splats_of_samples.h"
#include "renderer/view/texels_in_view.h"

namespace relief {
namespace {

/// The forms besides patches that must be made here. If a scene has only patches, engines derive
/// the form that they need.
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
                                   const LoadOptions& options, const PatchSections& sections,
                                   Progress& progress) {
  LoadedFile file;
  if (names_patch_file(path)) {
    RELIEF_TRY_ASSIGN(auto read, load_patches(path, progress, options.read, sections));
    file.patches = std::move(read.model);
    file.read = read.bytes;
  } else {
    RELIEF_TRY_ASSIGN(file.patches, load_model(path, progress, options.read, options.textures));
  }
  file.is_mesh = is_joined(file.patches) && !file.patches.is_of_points;
  if (forms.mesh) {
    RELIEF_TRY(add_mesh_of_patches(file, path));
  }
  if (forms.splats) file.splats = splats_of_samples(file.patches);
  return file;
}

/// Paints the points, for forms that are made of them. Returns the scale, if points have one.
Result<std::optional<ColourScale>> colour_scan(const ColourBy& colour_by, bool draws_points,
                                               Points& points) {
  RELIEF_TRY_ASSIGN(auto scale, scale_of_points(colour_by, points));
  if (!draws_points) return scale;
  if (!scale) {
    return make_error(
        "--colour-by {} is how far patches are from the points, but this engine draws the points "
        "or faces themselves; use onepass, or convert the scan with --scalars {}",
        kDistanceScalar, kDistanceScalar);
  }
  paint_points(colour_by, *scale, points);
  return scale;
}

/// A scan in the forms that are needed, and what it is coloured by.
struct LoadedScan {
  LoadedFile file;
  std::optional<ColourScale> scale;
};

Result<LoadedScan> load_scan(const std::filesystem::path& path, const LoadOptions& options,
                             FormNeeds needs, Progress& progress) {
  const std::optional<ColourBy>& colour_by = options.colour_by;
  ReadOptions read = options.read;
  if (colour_by) read.scalars = scalars_for(*colour_by);
  TextureChoice textures = options.textures;
  if (colour_by) textures = TextureChoice{true, {}};
  textures.of_points = needs.textured_splats && !needs.patches && !needs.mesh;
  auto scan = load_mesh(path, textures, progress, read);
  if (!scan) return scan.error();
  if (options.on_points) options.on_points(scan->points);
  LoadedScan made;
  LoadedFile& file = made.file;
  set_extent(file.patches, scan->points.positions);
  file.patches.stance = stance_of(scan->points);
  const bool has_triangles = !scan->points.triangles.empty();
  file.is_mesh = has_triangles;
  if (colour_by) {
    const bool draws_points = needs.splats || (needs.mesh && has_triangles);
    auto scale = colour_scan(*colour_by, draws_points, scan->points);
    if (!scale) return make_error("{}: {}", path.string(), scale.error().message);
    made.scale = *std::move(scale);
  }
  if (needs.mesh && has_triangles) file.mesh = mesh_of_points(scan->points);
  file.has_faces = file.mesh.has_value();
  if (needs.splats) {
    auto splats = splats_of_points(scan->points, progress);
    if (!splats) return make_error("{}: {}", path.string(), splats.error().message);
    file.splats = std::move(*splats);
    if (needs.textured_splats) texture_splats(scan->points, *file.splats);
  }
  const bool meshes_patches = needs.mesh && !has_triangles;
  if (!needs.patches && !meshes_patches) return made;
  ConvertOptions converting = options.convert;
  if (colour_by) {
    scan->points.colours = {};
    converting.distances = colour_by->scalar == kDistanceScalar;
  }
  auto converted = convert(std::move(scan->points), converting, progress);
  if (!converted) return make_error("{}: {}", path.string(), converted.error().message);
  file.patches = std::move(converted->model);
  if (colour_by) {
    auto scale = paint_patches(*colour_by, std::move(made.scale), file.patches);
    if (!scale) return make_error("{}: {}", path.string(), scale.error().message);
    made.scale = *std::move(scale);
  }
  if (!meshes_patches) return made;
  RELIEF_TRY(add_mesh_of_patches(file, path));
  return made;
}

/// Whether a file becomes patches without points.
bool is_patches(const std::filesystem::path& path, const ReadOptions& options) {
  return names_patch_file(path) || is_raster(path, options.format);
}

using LoadedFiles = std::map<std::filesystem::path, LoadedFile>;
using TreeFiles = std::map<std::filesystem::path, PatchTree>;

/// The patch files that have tiles, opened.
Result<TreeFiles> open_trees(const std::vector<SceneModel>& models) {
  TreeFiles trees;
  for (const SceneModel& model : models) {
    if (!names_patch_file(model.file) || trees.find(model.file) != trees.end()) continue;
    RELIEF_TRY_ASSIGN(auto tree, PatchTree::open(model.file));
    if (tree.tiles().size() > 1) trees.emplace(model.file, std::move(tree));
  }
  return trees;
}

/// The scene's bounds, before any patch of the trees is read.
Result<PatchModel> extent_of(const std::vector<SceneModel>& models, const LoadedFiles& loaded,
                             const TreeFiles& trees) {
  SceneAssembler assembler(models.size() > 1);
  RELIEF_TRY(for_each_use(models, [&](const auto& path, const FileUse& use) {
    const auto tree = trees.find(path);
    if (tree == trees.end() && loaded.at(path).volume) {
      assembler.add_extent(extent_of(*loaded.at(path).volume, use.where));
      return Status();
    }
    LoadedFile file;
    file.patches =
        tree == trees.end() ? without_patches(loaded.at(path).patches) : tree->second.extent();
    return assembler.add(file, use);
  }));
  return assembler.take().patches;
}

/// Reads the tiles of the trees that the views show.
Status load_trees(const TreeFiles& trees, const Audience& audience, const PatchSections& sections,
                  LoadedFiles& loaded, Progress& progress) {
  for (const auto& [path, tree] : trees) {
    RELIEF_TRY_ASSIGN(auto read, read_in_view(tree, audience.of(path), progress, sections));
    progress.note(fmt::format("{}: read {} of {} tiles, {} patches with {} samples", path.string(),
                              read.tiles, tree.tiles().size(), read.model.patches.size(),
                              read.samples));
    loaded[path].patches = std::move(read.model);
    loaded[path].read = read.bytes;
    loaded[path].patches.stance = tree.extent().stance;
  }
  return {};
}

/// The forms that the engines of the views prefer.
Result<FormNeeds> needs_of(const ScenePlan& plan, std::span<const EngineEntry> among) {
  FormNeeds needs;
  for (const PlannedView& view : plan.views) {
    RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_of(view, among));
    // Of volumes that stand beside surfaces, the engine that draws these.
    const EngineEntry* const of_surfaces = find_engine(engine->surfaces_by, among);
    const ModelForm form = (of_surfaces != nullptr ? of_surfaces : engine)->forms.front();
    needs.patches |= form == ModelForm::Patches;
    needs.splats |= form == ModelForm::Splats;
    needs.textured_splats |= form == ModelForm::Splats && engine->capabilities.textures_splats;
    needs.mesh |= form == ModelForm::Mesh;
  }
  return needs;
}

/// Splats with the image's colours, spread over the faces of the plan's first model.
Result<LoadedScene> load_textured_splats(const ScenePlan& plan, const LoadOptions& options,
                                         Progress& progress) {
  AcquireOptions acquisition = options.acquisition;
  const OptionValues& values = plan.views.front().settings.options;
  if (const auto cutoff = values.find("cutoff"); cutoff != values.end())
    acquisition.cutoff = std::get<double>(cutoff->second);
  RELIEF_TRY_ASSIGN(auto splats, acquire_splats(plan.models.front().file, options.textures,
                                                acquisition, progress));
  LoadedScene scene;
  set_extent(scene.patches, splats.positions);
  scene.splats = std::move(splats);
  return scene;
}

}  // namespace

Result<LoadedScene> load_models(const std::vector<SceneModel>& models, const LoadOptions& options,
                                FormNeeds needs, Progress& progress, const ViewsOf& views,
                                const PatchSections& sections) {
  if (options.colour_by && models.size() > 1)
    return make_error("only one model can be coloured by a scalar; the scene has {}",
                      models.size());
  const bool has_scans =
      std::any_of(models.begin(), models.end(), [&options](const SceneModel& model) {
        return !is_patches(model.file, options.read) && !has_kernels(model, options.volume);
      });
  const Forms forms{needs.mesh && has_scans, needs.splats && has_scans};
  // Splats and meshes are made of all patches.
  const bool may_choose = views && !needs.mesh && !needs.splats;
  const auto trees = may_choose ? open_trees(models) : Result(TreeFiles());
  if (!trees) return trees.error();

  LoadedFiles loaded;
  std::optional<ColourScale> colours;
  for (const SceneModel& model : models) {
    if (loaded.find(model.file) != loaded.end() || trees->find(model.file) != trees->end())
      continue;
    if (has_kernels(model, options.volume)) {
      RELIEF_TRY_ASSIGN(loaded[model.file].volume,
                        load_part(model, options.volume, options.read, progress));
    } else if (is_patches(model.file, options.read)) {
      RELIEF_TRY_ASSIGN(auto file, load_patch_file(model.file, forms, options, sections, progress));
      loaded.emplace(model.file, std::move(file));
    } else {
      RELIEF_TRY_ASSIGN(auto scan, load_scan(model.file, options, needs, progress));
      loaded.emplace(model.file, std::move(scan.file));
      colours = std::move(scan.scale);
    }
  }
  const bool drops_texels = may_choose && options.detail == KeptDetail::OfViews;
  std::optional<Audience> audience;
  if (!trees->empty() || drops_texels) {
    RELIEF_TRY_ASSIGN(auto extent, extent_of(models, loaded, *trees));
    RELIEF_TRY_ASSIGN(auto settings, views(extent));
    audience.emplace(models, std::move(settings), std::move(extent));
    RELIEF_TRY(load_trees(*trees, *audience, sections, loaded, progress));
  }
  if (options.colour_by && !has_scans) {
    const std::filesystem::path& file = models.front().file;
    auto scale = paint_patches(*options.colour_by, {}, loaded[file].patches);
    if (!scale) return make_error("{}: {}", file.string(), scale.error().message);
    colours = *std::move(scale);
  }
  SectionBytes read;
  for (auto& [path, file] : loaded) {
    read += file.read;
    PatchModel& patches = file.patches;
    if (drops_texels)
      drop_unseen_texels(audience->of(path), patches.patches, patches.has_label_colours);
  }
  SceneAssembler assembler(models.size() > 1);
  RELIEF_TRY(for_each_use(models, [&](const auto& path, const FileUse& use) {
    return assembler.add(loaded.at(path), use);
  }));
  LoadedScene scene = assembler.take();
  scene.colours = std::move(colours);
  scene.read = read;
  return scene;
}

Result<LoadedScene> load_scene(const ScenePlan& plan, const LoadOptions& options,
                               Progress& progress, std::span<const EngineEntry> among) {
  RELIEF_TRY(check_kernels(plan, options.volume, among));
  if (plan.models.size() == 1 && has_kernels(plan.models.front(), options.volume))
    return load_kernels(plan, options.volume, options.read, progress);
  RELIEF_TRY_ASSIGN(const FormNeeds needs, needs_of(plan, among));
  if (needs.splats && !needs.textured_splats && !options.textures.image.empty())
    return load_textured_splats(plan, options, progress);
  LoadOptions of_plan = options;
  // Heights are along the up direction of the image.
  if (of_plan.colour_by && !of_plan.colour_by->up)
    of_plan.colour_by->up = plan.views.front().settings.up;
  PatchSections sections;
  if (options.detail == KeptDetail::OfViews) {
    RELIEF_TRY_ASSIGN(sections, sections_of(plan, of_plan.colour_by.has_value(), among));
  }
  const ViewsOf views = [&](const PatchModel& extent) {
    return render_settings_of(plan, extent, among);
  };
  return load_models(plan.models, of_plan, needs, progress, views, sections);
}

}  // namespace relief
