// Levels of patches on the GPU, wherever they stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/geometry/cells/levels.h"
#include "renderer/geometry/samples/samples.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/cell_store.h"
#include "renderer/store/maps/map_bands.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/sample_pages.h"
#include "renderer/store/store_limits.h"
#include "shaders/include/shared.h"

namespace relief {

/// A level of a patch.
struct Grid {
  std::size_t patch = 0;  ///< in PatchModel::patches
  std::uint32_t level = 0;
  const Patch* nodes = nullptr;  ///< in the model's frame
  PatchSamples shape;            ///< without the records, which are on the GPU
  RecordRun records;
  UploadedCells cells;
  shared::PatchInfo info{};  ///< all but where it stands, its id and its material
};

/// The maps of the grids.
struct GridMaps {
  std::optional<Texture> heights;
  std::optional<Texture> normals;
  std::optional<Texture> colours;
  std::optional<Texture> masks;
};

/// Makes levels of patches as they are asked for, each once, and uploads them together.
class GridUpload {
 public:
  /// `model` and `needs` must outlive it.
  GridUpload(const StoreLimits& limits, const PatchModel& model, const StoreNeeds& needs);

  /// The index of the level. Fails if OpenGL can't draw as many samples.
  Result<std::size_t> get(std::size_t patch, std::uint32_t level);

  [[nodiscard]] const Grid& grid(std::size_t index) const { return grids_[index]; }

  /// Uploads the maps of all grids, and notes in Grid::info where they are.
  Result<GridMaps> make_maps(const Gl& gl);

  /// Packs the maps of all grids into images instead, which have no mip levels, and notes in
  /// Grid::info where they are in them.
  MapBands make_bands();

  std::vector<std::vector<SampleRecord>> take_records() { return records_.take(); }
  std::vector<CellPageData> take_cells() { return cells_.take(); }

 private:
  const PatchModel& model_;
  const StoreNeeds& needs_;
  SamplePages records_;
  CellPages cells_;
  std::deque<PatchLevel> coarser_;  ///< whose elements stay where they are
  std::vector<Grid> grids_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> numbers_;
};

}  // namespace relief
