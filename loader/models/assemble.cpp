#include "loader/models/assemble.h"

#include <iterator>
#include <utility>

#include "common/transform.h"
#include "loader/models/load_volume.h"
#include "renderer/append.h"

namespace relief {
namespace {

/// Moves a file's triangles and points to their position, gives them their material and appends
/// them. `patches_before`: how many patches the earlier models have.
Status add_forms(LoadedScene& scene, LoadedFile file, const FileUse& use,
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

}  // namespace

Status SceneAssembler::add(LoadedFile& file, const FileUse& use) {
  if (file.volume) return add_volume(file, use);
  const std::uint32_t patches_before = patches_;
  scene_.has_faces |= file.is_mesh;
  RELIEF_TRY(several_ ? add_model_instance(file, use) : move_model(file.patches, use));
  return add_forms(scene_, use.is_last ? std::move(file) : LoadedFile(file), use, patches_before);
}

Status SceneAssembler::add_volume(LoadedFile& file, const FileUse& use) {
  VolumePart part = use.is_last ? *std::exchange(file.volume, {}) : *file.volume;
  part.material = use.material;
  part.settings = use.model;
  add_extent(extent_of(part, use.where));
  RELIEF_TRY(move_part(part, use.where));
  if (!scene_.volumes) scene_.volumes.emplace();
  scene_.volumes->list.push_back(std::move(part));
  return {};
}

void SceneAssembler::add_extent(const PatchModel& extent) {
  extend_extent(scene_.patches, extent);
}

Status SceneAssembler::move_model(PatchModel& model, const FileUse& use) {
  for (Patch& patch : model.patches) patch.material = use.material;
  model.is_closed = use.is_closed.value_or(model.is_closed);
  patches_ += static_cast<std::uint32_t>(model.patches.size());
  Status moved = transform_model(model, use.where);
  if (moved) append_model(scene_.patches, std::exchange(model, {}));
  return moved;
}

Status SceneAssembler::add_model_instance(LoadedFile& file, const FileUse& use) {
  PatchModel& model = file.patches;
  if (!file.run) {
    std::vector<Patch>& all = scene_.patches.patches;
    file.run = {static_cast<std::uint32_t>(all.size()),
                static_cast<std::uint32_t>(model.patches.size())};
    append_joined(scene_.patches, model);
    std::move(model.patches.begin(), model.patches.end(), std::back_inserter(all));
    model = without_patches(model);
  }
  const PatchRun run = *file.run;
  patches_ += run.count;
  PatchModel extent = model;
  extent.is_closed = use.is_closed.value_or(model.is_closed);
  return add_instance(scene_.patches, {run.first, run.count, use.where, use.material}, extent);
}

}  // namespace relief
