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
#include "renderer/geometry/levels.h"
#include "renderer/geometry/samples.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/cell_store.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/sample_pages.h"
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

/// Uploads levels of patches as they are asked for, each once.
class GridUpload {
 public:
  /// All must outlive it.
  GridUpload(const Gl& gl, const PatchModel& model, const StoreNeeds& needs);

  /// The index of the level. Fails if OpenGL can't draw as many samples.
  Result<std::size_t> get(std::size_t patch, std::uint32_t level);

  [[nodiscard]] const Grid& grid(std::size_t index) const { return grids_[index]; }

  /// Uploads the maps of all grids, and notes in Grid::info where they are.
  Result<GridMaps> make_maps();

  std::vector<Table> take_pages() { return pages_.take(); }
  std::vector<CellPage> take_cells(const Buffer& positions) { return cells_.take(positions); }

 private:
  const Gl& gl_;
  const PatchModel& model_;
  const StoreNeeds& needs_;
  SamplePages pages_;
  CellUpload cells_;
  std::deque<PatchLevel> coarser_;  ///< whose elements stay where they are
  std::vector<Grid> grids_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> numbers_;
};

}  // namespace relief
