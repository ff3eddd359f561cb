// From a scan's tiles on disk to its patch file.
#pragma once

#include <filesystem>
#include <string>

#include "common/progress.h"
#include "preprocess/convert_tiles.h"
#include "preprocess/stream/spread_points.h"
#include "preprocess/stream/tile_job.h"

namespace relief {

/// What is converted: the job's tiles, and how. `name`, of the first file, begins errors.
struct TileTask {
  std::string name;
  const TileJob& job;
  SpreadScan scan;
  const ConvertOptions& options;
  const PatchFileOptions& file_options;
};

/// Looks at each tile, makes their normals agree, chooses the spacing, resamples each tile, and
/// joins what came of it to `output`; what the job has done already is not done again.
Result<TiledResult> convert_spread(TileTask task, const std::filesystem::path& output,
                                   Progress& progress);

}  // namespace relief
