// Converts tiles of points on disk to tiles of patches.
#pragma once

#include <filesystem>
#include <string>

#include "common/error.h"
#include "common/patch_file/patch_file.h"
#include "common/progress.h"
#include "preprocess/tiles/spread_points.h"
#include "preprocess/tiles/tile_job.h"
#include "preprocess/tiles/tile_options.h"

namespace relief {

/// The tiles to convert, with points in `folder`, and the options. Errors begin with `name`, the
/// first file's.
struct TileTask {
  std::string name;
  const TileFolder& folder;
  const SpreadScan& scan;
  const ConvertOptions& options;
  const PatchFileOptions& file_options;
  bool is_clean = false;  ///< samples, without noise and stray points
};

/// The combined result of all parts in the folder.
struct ConvertedTiles {
  TiledResult result;
  PatchModel extent;  ///< spacing, bounds and sphere, no patches
  std::uint64_t patches = 0;
};

/// Surveys each tile, makes their normals consistent, chooses the spacing, resamples each tile, and
/// writes its patches to the folder (TileFolder::part). Skips existing results.
Result<ConvertedTiles> convert_spread(const TileTask& task, Progress& progress);

}  // namespace relief
