// What a model on the GPU is made of, before it is there.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/store/grid_upload.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/proxy_store.h"
#include "renderer/store/seam_store.h"
#include "renderer/store/store_limits.h"
#include "shaders/include/shared.h"

namespace relief {

/// The lists of a PatchStore.
struct CollectedModel {
  std::vector<StoredInstance> instances;
  std::vector<StoredPatch> patches;
  std::vector<float> diameters;  ///< parallel: of the model that it belongs to, world units
  std::vector<StoredLevels> levels;
  std::vector<StoredPart> parts;
  std::vector<glm::uvec2> positions;  ///< of parts, then of seams
  std::vector<StoredSeam> seams;
};

/// Collects a model, one instance after the other. Needs no OpenGL: on any thread.
class ModelCollector {
 public:
  /// `model`, `needs` and the views must outlive it.
  ModelCollector(const StoreLimits& limits, const PatchModel& model, const StoreNeeds& needs,
                 const UploadViews& views);

  /// Fails if OpenGL can't draw as many samples, or if it is stopped.
  Status add(const Instance& instance, const std::stop_token& stop = {});

  /// Adds the seams of all instances. Once, after the last: there was time to make them.
  Status add_seam_blocks();

  [[nodiscard]] CollectedModel& collected() { return out_; }
  [[nodiscard]] GridUpload& grids() { return grids_; }
  [[nodiscard]] ProxyUpload& proxies() { return proxies_; }
  [[nodiscard]] SeamUpload& seams() { return seams_; }

  /// The patch table. After grids() know where their maps are.
  [[nodiscard]] std::vector<shared::PatchInfo> table() const;

 private:
  /// What a row of the patch table says beside StoredPatch.
  struct Row {
    std::optional<std::size_t> grid;  ///< none: the frame of a mesh
    std::uint32_t id = 0;
  };

  /// A run of patches as all of its instances have it.
  struct Run {
    Proxy model;                        ///< model frame
    std::optional<std::uint32_t> mesh;  ///< what stands for it, if some view draws it from afar
    std::optional<Bounds> box;          ///< box_about, once it is asked for
  };

  /// What its instances share; without what only views from afar ask for where there is none.
  Run& run_at(const Instance& instance);
  Bounds box_of(const Instance& instance, Run& run);

  /// Where its patch is. If it meets others, with the errors of all levels that the views may
  /// choose: overlapping margins are farther off than levels, and cost six times as much at the
  /// finest (the Dragon: 242 ms a frame instead of 39).
  PatchExtent measured_extent(const Instance& instance, std::size_t patch,
                              std::span<const View> views);
  /// The levels of its patches that the views choose.
  Status add_near(const Instance& instance, std::span<const View> views,
                  const std::stop_token& stop);
  void add_grid(std::size_t index, const Transform& where, std::uint8_t material, std::uint32_t id);
  /// The parts of the level that was added last.
  void add_parts(std::size_t index);
  /// The seams of its patches that meet others, over rows of their own, which lie as the patches
  /// do.
  Result<PatchRun> add_seams(const Instance& instance);
  /// The meshes that stand for it, made when it is the first of its run.
  Result<StoredInstance::StoredProxy> add_proxy(const Instance& instance, Run& run);

  const PatchModel& model_;
  const StoreNeeds& needs_;
  std::span<const View> views_;
  bool all_levels_;
  std::uint32_t finest_;
  CollectedModel out_;
  GridUpload grids_;
  ProxyUpload proxies_;
  SeamUpload seams_;
  std::vector<PatchExtent> extents_;  ///< of the model's patches, where they are stored
  std::map<std::pair<std::uint32_t, std::uint32_t>, Run> runs_;
  std::vector<Row> rows_;                  ///< parallel to CollectedModel::patches
  std::vector<std::size_t> seam_patches_;  ///< of each seam, in the model
  std::uint32_t first_id_ = 0;             ///< of the instance at work
};

}  // namespace relief
