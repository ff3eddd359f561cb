// From tiles of points on disk to tiles of patches.
#pragma once

#include <filesystem>
#include <string>

#include "common/progress.h"
#include "preprocess/convert_tiles.h"
#include "preprocess/tiles/spread_points.h"
#include "preprocess/tiles/tile_job.h"

namespace relief {

/// What is converted: the tiles whose points are in `folder`, and how. `name`, of the first file,
/// begins errors.
struct TileTask {
  std::string name;
  const TileFolder& folder;
  const SpreadScan& scan;
  const ConvertOptions& options;
  const PatchFileOptions& file_options;
};

/// What the parts in the folder are together.
struct ConvertedTiles {
  TiledResult result;
  PatchModel extent;  ///< spacing, bounds and sphere, no patches
  std::uint64_t patches = 0;
};

/// Looks at each tile, makes their normals agree, chooses the spacing, resamples each tile, and
/// leaves each tile's patches in the folder (TileFolder::part); what is there already is not made
/// again.
Result<ConvertedTiles> convert_spread(const TileTask& task, Progress& progress);

}  // namespace relief
