#include "renderer/store/collect_model.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>

#include "common/progress.h"
#include "common/transform.h"

namespace relief {
namespace {

/// A mesh that stands for a model has one material.
bool has_one_material(const PatchModel& model) {
  return !model.instances.empty() ||
         std::all_of(model.patches.begin(), model.patches.end(), [&model](const Patch& patch) {
           return patch.material == model.patches.front().material;
         });
}

std::vector<std::uint32_t> all_levels_of(const PatchExtent& extent, std::uint32_t finest) {
  const std::uint32_t first = std::min(finest, extent.levels - 1);
  std::vector<std::uint32_t> levels(extent.levels - first);
  std::iota(levels.begin(), levels.end(), first);
  return levels;
}

PatchExtent moved(const Transform& transform, const PatchExtent& extent) {
  PatchExtent there = extent;
  there.centre = relief::moved(transform, extent.centre);
  there.radius *= transform.scale;
  there.spacing *= transform.scale;
  for (double& error : there.errors) error *= transform.scale;
  return there;
}

/// Seams reach this far beyond a patch's samples, in spacings.
constexpr double kSeamReach = 2.5;

/// Whether maps of the patches that a view shows have more detail than their surface.
bool has_fine_detail(std::span<const Patch> patches, const StoreNeeds& needs) {
  return std::any_of(patches.begin(), patches.end(), [&needs](const Patch& patch) {
    return (needs.colours && !patch.colours.empty()) || (needs.normals && patch.normals.scale > 1);
  });
}

Proxy proxy_of(std::span<const Patch> patches, bool are_joined, const StoreNeeds& needs) {
  Proxy model;
  if (are_joined) model.diameter = kProxyDiameterJoined;
  double coarsest = 0.0;
  for (const Patch& patch : patches) coarsest = std::max(coarsest, patch.spacing);
  model.sphere = sphere_about(patches);
  model.pixels = has_fine_detail(patches, needs) ? kProxyPixelsOfMaps : kProxyPixels;
  model.spacings = proxy_spacings(model.sphere, coarsest, model.diameter);
  return model;
}

}  // namespace

ModelCollector::ModelCollector(const StoreLimits& limits, const PatchModel& model,
                               const StoreNeeds& needs, const UploadViews& views)
    : model_(model),
      needs_(needs),
      views_(views.views),
      all_levels_(views.all_levels),
      finest_(views.finest),
      grids_(limits, model, needs),
      proxies_(limits),
      seams_(limits, model, needs.cells, needs.masks) {
  extents_.reserve(model.patches.size());
  for (const Patch& patch : model.patches) extents_.push_back(extent_of(patch));
}

Status ModelCollector::add(const Instance& instance, const std::stop_token& stop) {
  Run& run = run_at(instance);
  const Transform& where = instance.transform;
  std::vector<View> near_views;
  StoredInstance stored{relief::moved(where, run.model),
                        static_cast<std::uint32_t>(out_.levels.size()),
                        0,
                        {},
                        std::nullopt,
                        glm::determinant(where.rotation) < 0.0,
                        std::nullopt};
  if (instance.is_closed && make_use_of_bodies(views_))
    stored.body = Body{box_of(instance, run), where};
  for (const View& view : views_) {
    if (!is_proxy(view, stored.model)) near_views.push_back(view);
  }
  const bool is_proxy_in_some =
      all_levels_ ? !run.model.spacings.empty() : near_views.size() < views_.size();
  if (is_proxy_in_some) {
    RELIEF_TRY_ASSIGN(const auto proxy, add_proxy(instance, run));
    stored.proxy = proxy;
  }
  if (all_levels_ || views_.empty() || !near_views.empty()) {
    RELIEF_TRY(add_near(instance, near_views, stop));
    stored.count = instance.count;
    if (needs_.cells) {
      RELIEF_TRY_ASSIGN(stored.seams, add_seams(instance));
    }
  }
  out_.diameters.resize(out_.patches.size(), 2.0F * static_cast<float>(stored.model.sphere.radius));
  out_.instances.push_back(std::move(stored));
  first_id_ += instance.count;
  return {};
}

ModelCollector::Run& ModelCollector::run_at(const Instance& instance) {
  const auto [found, is_new] = runs_.try_emplace({instance.first, instance.count});
  if (!is_new) return found->second;
  const auto patches = [&] {
    return std::span(model_.patches).subspan(instance.first, instance.count);
  };
  if (needs_.bodies) found->second.model.sphere = sphere_about(patches());
  const bool may_be_proxy =
      std::any_of(views_.begin(), views_.end(),
                  [](const View& view) { return view.proxy_diameter > 0.0; }) &&
      has_one_material(model_);
  if (may_be_proxy)
    found->second.model = proxy_of(patches(), run_of(model_, instance.first) != nullptr, needs_);
  return found->second;
}

Bounds ModelCollector::box_of(const Instance& instance, Run& run) {
  if (!run.box)
    run.box = box_about(std::span(model_.patches).subspan(instance.first, instance.count));
  return *run.box;
}

PatchExtent ModelCollector::measured_extent(const Instance& instance, std::size_t patch,
                                            std::span<const View> views) {
  PatchExtent& extent = extents_[patch];
  if (run_of(model_, patch) == nullptr) return moved(instance.transform, extent);
  std::uint32_t coarsest = all_levels_ ? extent.levels - 1 : 0;
  for (const View& view : views)
    coarsest = std::max(coarsest, coarsest_level(view, moved(instance.transform, extent)));
  measure_levels(model_.patches[patch], coarsest, extent);
  return moved(instance.transform, extent);
}

Status ModelCollector::add_near(const Instance& instance, std::span<const View> views,
                                const std::stop_token& stop) {
  for (std::uint32_t k = 0; k < instance.count; ++k) {
    if (stop.stop_requested()) return interrupted_error();
    const std::size_t p = instance.first + k;
    const PatchExtent extent = measured_extent(instance, p, views);
    const std::vector<std::uint32_t> kept =
        all_levels_ ? all_levels_of(extent, finest_) : levels_in(views, extent);
    out_.levels.push_back({extent, static_cast<std::uint32_t>(out_.patches.size()),
                           static_cast<std::uint32_t>(kept.size())});
    const std::uint8_t material =
        model_.instances.empty() ? model_.patches[p].material : instance.material;
    for (const std::uint32_t level : kept) {
      RELIEF_TRY_ASSIGN(const std::size_t grid, grids_.get(p, level));
      add_grid(grid, instance.transform, material, first_id_ + k);
      add_parts(grid);
    }
  }
  return {};
}

void ModelCollector::add_grid(std::size_t index, const Transform& where, std::uint8_t material,
                              std::uint32_t id) {
  const Grid& grid = grids_.grid(index);
  const MovedFrame frame = relief::moved(where, *grid.nodes);
  StoredPatch kept;
  kept.level = grid.level;
  kept.material = material;
  kept.instance = static_cast<std::uint32_t>(out_.instances.size());
  kept.origin = frame.origin;
  kept.axes = frame.axes;
  kept.spacing = frame.spacing;
  kept.side = std::max(grid.nodes->width, grid.nodes->height);
  kept.centre = frame.origin + frame.axes * (frame.spacing * grid.shape.centre);
  kept.radius = frame.spacing * grid.shape.radius;
  kept.widest_disc = frame.spacing * grid.shape.widest_disc;
  kept.records = grid.records;
  out_.patches.push_back(kept);
  rows_.push_back({index, id});
}

void ModelCollector::add_parts(std::size_t index) {
  const auto number = static_cast<std::uint32_t>(out_.patches.size() - 1);
  const StoredPatch& patch = out_.patches.back();
  for (const UploadedCells::Part& part : grids_.grid(index).cells.parts) {
    out_.parts.push_back({number, patch.origin + patch.axes * (patch.spacing * part.centre),
                          patch.spacing * part.radius, part.normals, part.buffers});
    out_.positions.emplace_back(number, part.corner.x | (part.corner.y << 16U));
  }
}

Result<PatchRun> ModelCollector::add_seams(const Instance& instance) {
  const auto first = static_cast<std::uint32_t>(out_.seams.size());
  for (std::uint32_t k = 0; k < instance.count; ++k) {
    const std::size_t p = instance.first + k;
    if (run_of(model_, p) == nullptr) continue;
    const PatchExtent extent = moved(instance.transform, extents_[p]);
    RELIEF_TRY_ASSIGN(const std::size_t grid, grids_.get(p, 0));
    const std::uint8_t material =
        model_.instances.empty() ? model_.patches[p].material : instance.material;
    out_.seams.push_back({static_cast<std::uint32_t>(out_.patches.size()),
                          0,
                          extent.centre,
                          extent.radius + kSeamReach * extent.spacing,
                          extent,
                          {}});
    seam_patches_.push_back(p);
    add_grid(grid, instance.transform, material, first_id_ + k);
  }
  return PatchRun{first, static_cast<std::uint32_t>(out_.seams.size()) - first};
}

Result<StoredInstance::StoredProxy> ModelCollector::add_proxy(const Instance& instance, Run& run) {
  if (!run.mesh) {
    std::vector<JoinedPatches> joined;
    for (const PatchRun& some : model_.joined) {
      if (some.first >= instance.first && some.first < instance.first + instance.count)
        joined.push_back({some.first - instance.first, &seams_.made(some)});
    }
    RELIEF_TRY_ASSIGN(
        const std::uint32_t added,
        proxies_.add(std::span(model_.patches).subspan(instance.first, instance.count), joined,
                     run.model));
    run.mesh = added;
  }
  const StoredProxyMesh& mesh = proxies_.mesh(*run.mesh);
  StoredPatch frame;
  frame.material = instance.material;
  frame.instance = static_cast<std::uint32_t>(out_.instances.size());
  frame.origin = relief::moved(instance.transform, mesh.origin);
  frame.axes = instance.transform.rotation;
  frame.spacing = instance.transform.scale * mesh.unit;
  const auto patch = static_cast<std::uint32_t>(out_.patches.size());
  const StoredInstance::StoredProxy proxy{*run.mesh, patch, proxies_.add_instance(patch)};
  out_.patches.push_back(frame);
  rows_.push_back({std::nullopt, first_id_});
  return proxy;
}

Status ModelCollector::add_seam_blocks() {
  for (std::size_t s = 0; s < out_.seams.size(); ++s) {
    StoredSeam& seam = out_.seams[s];
    const PatchRun run = *run_of(model_, seam_patches_[s]);
    RELIEF_TRY_ASSIGN(const std::span<const SeamBlocks> shares, seams_.get(run));
    seam.blocks = shares[seam_patches_[s] - run.first];
    seam.number = static_cast<std::uint32_t>(out_.positions.size());
    out_.positions.emplace_back(seam.patch, 0);
  }
  return {};
}

std::vector<shared::PatchInfo> ModelCollector::table() const {
  std::vector<shared::PatchInfo> table;
  table.reserve(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const StoredPatch& patch = out_.patches[k];
    shared::PatchInfo info{};
    if (rows_[k].grid) info = grids_.grid(*rows_[k].grid).info;
    info.axis_u = {glm::vec3(patch.axes[0]), static_cast<float>(patch.spacing)};
    info.axis_v = {glm::vec3(patch.axes[1]), info.axis_v.w};
    info.axis_n = {glm::vec3(patch.axes[2]), info.axis_n.w};
    info.nodes.z = static_cast<int>(rows_[k].id);
    info.heights.w = patch.material;
    table.push_back(info);
  }
  return table;
}

}  // namespace relief
