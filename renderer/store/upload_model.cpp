#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "common/transform.h"
#include "renderer/store/grid_upload.h"
#include "renderer/store/patch_store.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// A model without instances is one instance that leaves it where it is.
std::vector<Instance> instances_of(const PatchModel& model) {
  if (!model.instances.empty()) return model.instances;
  const std::uint8_t material = model.patches.empty() ? 0 : model.patches.front().material;
  return {{0, static_cast<std::uint32_t>(model.patches.size()), {}, material, model.is_closed}};
}

/// A mesh that stands for a model has one material.
bool has_one_material(const PatchModel& model) {
  return !model.instances.empty() ||
         std::all_of(model.patches.begin(), model.patches.end(), [&model](const Patch& patch) {
           return patch.material == model.patches.front().material;
         });
}

std::vector<std::uint32_t> all_levels_of(const PatchExtent& extent) {
  std::vector<std::uint32_t> levels(extent.levels);
  std::iota(levels.begin(), levels.end(), 0U);
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

/// A run of patches as all of its instances have it.
struct Run {
  Proxy model;                        ///< model frame
  std::optional<std::uint32_t> mesh;  ///< what stands for it, if some view draws it from afar
  std::optional<Bounds> box;          ///< box_about, once it is asked for
};

/// Whether maps of the patches show more than their surface.
bool has_fine_detail(std::span<const Patch> patches) {
  return std::any_of(patches.begin(), patches.end(), [](const Patch& patch) {
    return !patch.colours.empty() || patch.normals.scale > 1;
  });
}

Run run_of(std::span<const Patch> patches, bool are_joined) {
  Run run;
  if (are_joined) run.model.diameter = kProxyDiameterJoined;
  double coarsest = 0.0;
  for (const Patch& patch : patches) coarsest = std::max(coarsest, patch.spacing);
  run.model.sphere = sphere_about(patches);
  run.model.pixels = has_fine_detail(patches) ? kProxyPixelsOfMaps : kProxyPixels;
  run.model.spacings = proxy_spacings(run.model.sphere, coarsest, run.model.diameter);
  return run;
}

/// Uploads a model, one instance after the other.
class ModelUpload {
 public:
  ModelUpload(const Gl& gl, const PatchModel& model, const StoreNeeds& needs,
              const UploadViews& views)
      : gl_(gl),
        model_(model),
        needs_(needs),
        views_(views.views),
        all_levels_(views.all_levels),
        grids_(gl, model, needs),
        proxy_(gl),
        seam_upload_(gl, model, needs.cells, needs.masks) {
    extents_.reserve(model.patches.size());
    for (const Patch& patch : model.patches) extents_.push_back(extent_of(patch));
  }

  Status add(const Instance& instance) {
    Run& run = run_at(instance);
    const Transform& where = instance.transform;
    std::vector<View> near_views;
    StoredInstance stored{relief::moved(where, run.model),
                          static_cast<std::uint32_t>(levels_.size()),
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
      RELIEF_TRY(add_near(instance, near_views));
      stored.count = instance.count;
      if (needs_.cells) {
        RELIEF_TRY_ASSIGN(stored.seams, add_seams(instance));
      }
    }
    diameters_.resize(patches_.size(), 2.0F * static_cast<float>(stored.model.sphere.radius));
    instances_.push_back(std::move(stored));
    first_id_ += instance.count;
    return {};
  }

  Result<PatchStore> take() {
    RELIEF_TRY_ASSIGN(GridMaps maps, grids_.make_maps());
    Table table = make_patch_table();
    PatchStore store{std::move(instances_),
                     std::move(patches_),
                     std::move(levels_),
                     grids_.take_pages(),
                     std::move(table),
                     std::nullopt,
                     std::nullopt,
                     std::move(maps.heights),
                     std::move(maps.normals),
                     std::move(maps.colours),
                     std::move(maps.masks),
                     std::nullopt,
                     std::nullopt,
                     std::nullopt};
    // Last, so that there was time to make them.
    for (std::size_t s = 0; s < seams_.size(); ++s) {
      StoredSeam& seam = seams_[s];
      const PatchRun run = *relief::run_of(model_, seam_patches_[s]);
      RELIEF_TRY_ASSIGN(const std::span<const SeamBlocks> shares, seam_upload_.get(run));
      seam.blocks = shares[seam_patches_[s] - run.first];
      seam.number = static_cast<std::uint32_t>(positions_.size());
      positions_.emplace_back(seam.patch, 0);
    }
    if (needs_.cells) {
      Buffer positions =
          make_buffer(gl_, "part positions", std::span<const glm::uvec2>(positions_));
      std::vector<CellPage> pages = grids_.take_cells(positions);
      store.cells = CellStore{std::move(parts_), std::move(pages), std::move(positions)};
    }
    if (!seam_upload_.empty())
      store.seams = seam_upload_.take(std::move(seams_), store.cells->positions);
    if (!proxy_.empty()) store.proxies = proxy_.take(needs_.sources);
    if (needs_.bodies)
      store.bodies = make_table(gl_, "bodies", GL_R32F, std::span<const float>(diameters_));
    if (needs_.splats || !needs_.cells) {
      std::vector<std::uint32_t> indices(store.patches.size());
      std::iota(indices.begin(), indices.end(), 0U);
      store.indices = make_buffer(gl_, "patch indices", std::span<const std::uint32_t>(indices));
    }
    RELIEF_TRY(check_errors(gl_, "the model"));
    return store;
  }

 private:
  /// What a row of the patch table says beside StoredPatch.
  struct Row {
    std::optional<std::size_t> grid;  ///< none: the frame of a mesh
    std::uint32_t id = 0;
  };

  /// What its instances share; without what only views from afar ask for where there is none.
  Run& run_at(const Instance& instance) {
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
      found->second = run_of(patches(), relief::run_of(model_, instance.first) != nullptr);
    return found->second;
  }

  Bounds box_of(const Instance& instance, Run& run) {
    if (!run.box)
      run.box = box_about(std::span(model_.patches).subspan(instance.first, instance.count));
    return *run.box;
  }

  /// Where its patch is. If it meets others, with the errors of all levels that the views may
  /// choose: overlapping margins are farther off than levels, and cost six times as much at the
  /// finest (the Dragon: 242 ms a frame instead of 39).
  PatchExtent measured_extent(const Instance& instance, std::size_t patch,
                              std::span<const View> views) {
    PatchExtent& extent = extents_[patch];
    if (relief::run_of(model_, patch) == nullptr) return moved(instance.transform, extent);
    std::uint32_t coarsest = all_levels_ ? extent.levels - 1 : 0;
    for (const View& view : views)
      coarsest = std::max(coarsest, coarsest_level(view, moved(instance.transform, extent)));
    measure_levels(model_.patches[patch], coarsest, extent);
    return moved(instance.transform, extent);
  }

  /// The levels of its patches that the views choose.
  Status add_near(const Instance& instance, std::span<const View> views) {
    for (std::uint32_t k = 0; k < instance.count; ++k) {
      const std::size_t p = instance.first + k;
      const PatchExtent extent = measured_extent(instance, p, views);
      const std::vector<std::uint32_t> kept =
          all_levels_ ? all_levels_of(extent) : levels_in(views, extent);
      levels_.push_back({extent, static_cast<std::uint32_t>(patches_.size()),
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

  void add_grid(std::size_t index, const Transform& where, std::uint8_t material,
                std::uint32_t id) {
    const Grid& grid = grids_.grid(index);
    const PatchFrame frame = relief::moved(where, *grid.nodes);
    StoredPatch kept;
    kept.level = grid.level;
    kept.material = material;
    kept.instance = static_cast<std::uint32_t>(instances_.size());
    kept.origin = frame.origin;
    kept.axes = frame.axes;
    kept.spacing = frame.spacing;
    kept.side = std::max(grid.nodes->width, grid.nodes->height);
    kept.centre = frame.origin + frame.axes * (frame.spacing * grid.shape.centre);
    kept.radius = frame.spacing * grid.shape.radius;
    kept.widest_disc = frame.spacing * grid.shape.widest_disc;
    kept.records = grid.records;
    patches_.push_back(kept);
    rows_.push_back({index, id});
  }

  /// The parts of the level that was added last.
  void add_parts(std::size_t index) {
    const auto number = static_cast<std::uint32_t>(patches_.size() - 1);
    const StoredPatch& patch = patches_.back();
    for (const UploadedCells::Part& part : grids_.grid(index).cells.parts) {
      parts_.push_back({number, patch.origin + patch.axes * (patch.spacing * part.centre),
                        patch.spacing * part.radius, part.normals, part.buffers});
      positions_.emplace_back(number, part.corner.x | (part.corner.y << 16U));
    }
  }

  /// The seams of its patches that meet others, over rows of their own, which lie as the patches
  /// do.
  Result<PatchRun> add_seams(const Instance& instance) {
    const auto first = static_cast<std::uint32_t>(seams_.size());
    for (std::uint32_t k = 0; k < instance.count; ++k) {
      const std::size_t p = instance.first + k;
      if (relief::run_of(model_, p) == nullptr) continue;
      const PatchExtent extent = moved(instance.transform, extents_[p]);
      RELIEF_TRY_ASSIGN(const std::size_t grid, grids_.get(p, 0));
      const std::uint8_t material =
          model_.instances.empty() ? model_.patches[p].material : instance.material;
      seams_.push_back({static_cast<std::uint32_t>(patches_.size()),
                        0,
                        extent.centre,
                        extent.radius + kSeamReach * extent.spacing,
                        extent,
                        {}});
      seam_patches_.push_back(p);
      add_grid(grid, instance.transform, material, first_id_ + k);
    }
    return PatchRun{first, static_cast<std::uint32_t>(seams_.size()) - first};
  }

  /// The meshes that stand for it, made when it is the first of its run.
  Result<StoredInstance::StoredProxy> add_proxy(const Instance& instance, Run& run) {
    if (!run.mesh) {
      std::vector<JoinedPatches> joined;
      for (const PatchRun& some : model_.joined) {
        if (some.first >= instance.first && some.first < instance.first + instance.count)
          joined.push_back({some.first - instance.first, &seam_upload_.made(some)});
      }
      RELIEF_TRY_ASSIGN(
          const std::uint32_t added,
          proxy_.add(std::span(model_.patches).subspan(instance.first, instance.count), joined,
                     run.model));
      run.mesh = added;
    }
    const StoredProxyMesh& mesh = proxy_.mesh(*run.mesh);
    StoredPatch frame;
    frame.material = instance.material;
    frame.instance = static_cast<std::uint32_t>(instances_.size());
    frame.origin = relief::moved(instance.transform, mesh.origin);
    frame.axes = instance.transform.rotation;
    frame.spacing = instance.transform.scale * mesh.unit;
    const auto patch = static_cast<std::uint32_t>(patches_.size());
    const StoredInstance::StoredProxy proxy{*run.mesh, patch, proxy_.add_instance(patch)};
    patches_.push_back(frame);
    rows_.push_back({std::nullopt, first_id_});
    return proxy;
  }

  Table make_patch_table() {
    std::vector<shared::PatchInfo> table;
    table.reserve(rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const StoredPatch& patch = patches_[k];
      shared::PatchInfo info{};
      if (rows_[k].grid) info = grids_.grid(*rows_[k].grid).info;
      info.axis_u = {glm::vec3(patch.axes[0]), static_cast<float>(patch.spacing)};
      info.axis_v = {glm::vec3(patch.axes[1]), info.axis_v.w};
      info.axis_n = {glm::vec3(patch.axes[2]), info.axis_n.w};
      info.nodes.z = static_cast<int>(rows_[k].id);
      info.heights.w = patch.material;
      table.push_back(info);
    }
    return make_table(gl_, "patch table", GL_RGBA32I, std::span<const shared::PatchInfo>(table));
  }

  const Gl& gl_;
  const PatchModel& model_;
  const StoreNeeds& needs_;
  std::span<const View> views_;
  bool all_levels_;
  GridUpload grids_;
  ProxyUpload proxy_;
  SeamUpload seam_upload_;
  std::vector<PatchExtent> extents_;  ///< of the model's patches, where they are stored
  std::map<std::pair<std::uint32_t, std::uint32_t>, Run> runs_;
  std::vector<StoredInstance> instances_;
  std::vector<StoredPatch> patches_;
  std::vector<Row> rows_;         ///< parallel to `patches_`
  std::vector<float> diameters_;  ///< the same: of the model that it belongs to, world units
  std::vector<StoredLevels> levels_;
  std::vector<StoredPart> parts_;
  std::vector<StoredSeam> seams_;
  std::vector<std::size_t> seam_patches_;  ///< of each seam, in the model
  std::vector<glm::uvec2> positions_;
  std::uint32_t first_id_ = 0;  ///< of the instance at work
};

}  // namespace

Result<PatchStore> upload_model(const Gl& gl, const PatchModel& model, const StoreNeeds& needs,
                                const UploadViews& views) {
  ModelUpload upload(gl, model, needs, views);
  for (const Instance& instance : instances_of(model)) {
    RELIEF_TRY(upload.add(instance));
  }
  return upload.take();
}

}  // namespace relief
