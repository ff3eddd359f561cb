// Some patches of a model that are uploaded and dropped together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"
#include "common/patch.h"
#include "renderer/store/collect_model.h"

namespace relief {

/// All that the GPU is to have of some patches, ready to be copied there.
struct PatchChunk {
  CollectedModel lists;  ///< one instance; numbers count from the chunk's own first
  std::vector<shared::PatchInfo> table;
  std::vector<CellPageData> cells;
  std::vector<std::vector<SampleRecord>> records;
  MapBands maps;
  std::vector<shared::SeamVertex> seam_vertices;
  std::vector<std::uint32_t> seam_corners;
  std::uint32_t finest = 0;   ///< level that is there
  std::vector<Bounds> boxes;  ///< of each patch, world; filled in by who reads them

  /// What it takes in memory, and about what it takes on the GPU.
  [[nodiscard]] std::uint64_t bytes() const;
};

/// Prepares the levels of the patches of a model without instances from `finest` on; of patches
/// that meet others all. Needs no OpenGL: on any thread. `ids`: of the patches. Fails if OpenGL
/// can't draw as many samples.
Result<PatchChunk> prepare_chunk(const PatchModel& model, std::span<const std::uint32_t> ids,
                                 const StoreNeeds& needs, const StoreLimits& limits,
                                 std::uint32_t finest = 0);

}  // namespace relief
