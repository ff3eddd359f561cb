#include "loader/models/load_volume.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "common/extremes.h"
#include "common/patch_file/patch_file.h"
#include "common/volume/move.h"
#include "common/volume/transfer_function.h"
#include "loader/scene/view_settings.h"
#include "preprocess/gaussians/read_gaussians.h"
#include "preprocess/points/point_volume.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/read_points.h"
#include "renderer/volume/extent.h"
#include "renderer/volume/seen_nodes.h"

namespace relief {
namespace {

bool draws(const EngineEntry& engine, ModelForm form) {
  return std::find(engine.forms.begin(), engine.forms.end(), form) != engine.forms.end();
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

/// With the model's own layout.
Result<VolumeReadOptions> options_of(const SceneModel& model, const VolumeReadOptions& options) {
  if (model.raw.empty()) return options;
  auto layout = parse_raw_layout(model.raw);
  if (!layout) return make_error("{}: raw: {}", model.file.string(), layout.error().message);
  VolumeReadOptions own = options;
  own.raw = *layout;
  return own;
}

Status check_engine_of(const PlannedView& view, const ScenePlan& plan, const SceneModel& model,
                       std::span<const EngineEntry> among) {
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_of(view, among));
  if (!draws(*engine, ModelForm::Volume)) {
    return make_error(
        "{}: is a volume or a scene of 3D Gaussians, which engine {} can't draw; choose engine "
        "volume or volume-reference",
        model.file.string(), engine->name);
  }
  if (plan.models.size() > 1 && !draws(*engine, ModelForm::VolumeParts)) {
    return make_error(
        "{}: engine {} draws a single volume or scene of 3D Gaussians, and this scene has {} "
        "models; choose engine volume or volume-reference",
        plan.file.string(), engine->name, plan.models.size());
  }
  return {};
}

/// What the views of the plan's only model show of a volume, for their cameras. A function that
/// can't be read is left out here: the image says so.
std::vector<glm::dvec3> framed_points(const ScalarVolume& volume, const ScenePlan& plan) {
  const SceneModel& model = plan.models.front();
  std::set<std::string> transfers;  // each is made once: "auto" goes over all values
  std::set<double> isos;
  for (const PlannedView& view : plan.views) {
    const auto option = [&](std::string_view key) -> const OptionValue* {
      for (const OptionValues* const values : {&model.options, &view.settings.options}) {
        if (const auto found = values->find(key); found != values->end()) return &found->second;
      }
      return nullptr;
    };
    const OptionValue* const transfer = option("transfer");
    transfers.insert(transfer == nullptr ? VolumeSettings().transfer
                                         : std::get<std::string>(*transfer));
    if (const OptionValue* const iso = option("iso")) isos.insert(std::get<double>(*iso));
  }
  std::vector<TransferFunction> functions;
  for (const std::string& transfer : transfers) {
    if (auto function = transfer_function_for(transfer, volume))
      functions.push_back(*std::move(function));
  }
  std::vector<glm::dvec3> points =
      seen_nodes(volume, functions, std::vector<double>(isos.begin(), isos.end()));
  for (glm::dvec3& point : points) point = moved(model.transform, point);
  return points;
}

}  // namespace

bool has_kernels(const std::filesystem::path& path, const VolumeReadOptions& options) {
  if (options.scalar || is_volume(path, options)) return true;
  const auto found = is_gaussians(path);
  return found && *found;
}

bool has_kernels(const SceneModel& model, const VolumeReadOptions& options) {
  return !model.raw.empty() || has_kernels(model.file, options);
}

bool has_kernels(const std::vector<SceneModel>& models, const VolumeReadOptions& options) {
  return std::any_of(models.begin(), models.end(),
                     [&](const SceneModel& model) { return has_kernels(model, options); });
}

bool shows_kernels(const std::filesystem::path& input, const VolumeReadOptions& options) {
  const auto plan = plan_scene(input, {});
  return plan && has_kernels(plan->models, options);
}

void choose_volume_engine(ScenePlan& plan, const VolumeReadOptions& options) {
  if (!has_kernels(plan.models, options)) return;
  for (PlannedView& view : plan.views) {
    if (!view.settings.engine) view.settings.engine = kVolumeEngine;
  }
}

void fit_engine(ScenePlan& plan, const VolumeReadOptions& options) {
  const bool is_for_kernels = has_kernels(plan.models, options);
  for (PlannedView& view : plan.views) {
    const auto engine = engine_of(view);
    if (!engine || draws(**engine, ModelForm::Volume) == is_for_kernels) continue;
    view.settings.engine.reset();
    if (is_for_kernels) view.settings.engine = kVolumeEngine;
  }
}

Status check_kernels(const ScenePlan& plan, const VolumeReadOptions& options,
                     std::span<const EngineEntry> among) {
  if (options.raw && !plan.file.empty()) {
    return make_error("{}: --raw is for a single file; give the model of the scene the key raw",
                      plan.file.string());
  }
  if (options.scalar && !plan.file.empty()) {
    return make_error("{}: a scalar of points as a volume is for a single file, not a scene",
                      plan.file.string());
  }
  for (const SceneModel& model : plan.models) {
    if (!has_kernels(model, options)) {
      if (model.options.empty()) continue;
      return make_error("{}: has {}, which is for volumes and 3D Gaussians, and this is neither",
                        model.file.string(), model.options.begin()->first);
    }
    for (const SceneModel& other : plan.models) {
      if (other.file == model.file && other.raw != model.raw)
        return make_error("{}: two models read it with different layouts; copy the file",
                          model.file.string());
    }
    for (const PlannedView& view : plan.views)
      RELIEF_TRY(check_engine_of(view, plan, model, among));
  }
  return {};
}

Result<VolumePart> load_part(const SceneModel& model, const VolumeReadOptions& options,
                             const ReadOptions& read, Progress& progress) {
  RELIEF_TRY_ASSIGN(const VolumeReadOptions own, options_of(model, options));
  VolumePart part;
  if (own.scalar || is_volume(model.file, own)) {
    RELIEF_TRY_ASSIGN(part.what, read_nodes(model.file, own, read, progress));
  } else {
    RELIEF_TRY_ASSIGN(part.what, read_gaussians(model.file, progress));
  }
  return part;
}

Status move_part(VolumePart& part, const Transform& transform) {
  if (auto* const gaussians = std::get_if<GaussianCloud>(&part.what))
    return move_gaussians(*gaussians, transform);
  move_volume(std::get<ScalarVolume>(part.what), transform);
  return {};
}

PatchModel extent_of(const VolumePart& part, const Transform& transform) {
  PatchModel extent;
  std::visit(
      [&](const auto& what) {
        std::vector<glm::dvec3> points = extent_of(what);
        for (glm::dvec3& point : points) point = moved(transform, point);
        set_extent(extent, points);
        extent.stance = {transform.rotation * what.stance.up,
                         transform.rotation * what.stance.front};
      },
      part.what);
  return extent;
}

Result<LoadedScene> load_kernels(const ScenePlan& plan, const VolumeReadOptions& options,
                                 const ReadOptions& read, Progress& progress) {
  const SceneModel& model = plan.models.front();
  RELIEF_TRY_ASSIGN(VolumePart part, load_part(model, options, read, progress));
  LoadedScene scene;
  scene.patches = extent_of(part, model.transform);
  if (const auto* const volume = std::get_if<ScalarVolume>(&part.what)) {
    const std::vector<glm::dvec3> framed = framed_points(*volume, plan);
    if (!framed.empty()) scene.patches.extremes = extreme_points(framed, scene.patches.bounds);
  }
  if (const Status moved = move_part(part, model.transform); !moved)
    return make_error("{}: {}", model.file.string(), moved.error().message);
  if (auto* const volume = std::get_if<ScalarVolume>(&part.what))
    scene.volume = std::move(*volume);
  else
    scene.gaussians = std::get<GaussianCloud>(std::move(part.what));
  return scene;
}

}  // namespace relief
