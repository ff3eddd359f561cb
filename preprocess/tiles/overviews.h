// Coarser patches over the tiles of a large model, for viewers that are far away.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_tree.h"
#include "common/progress.h"
#include "preprocess/convert.h"
#include "preprocess/tiles/spread_points.h"
#include "preprocess/tiles/tile_job.h"

namespace relief {

/// The tiles whose patches are a job's own parts, and how they were made.
struct TiledModel {
  std::string name;  ///< of the scan's first file; begins errors
  const TileJob& job;
  const SpreadScan& scan;
  const ConvertOptions& options;
  const PatchFileOptions& file_options;
  double spacing = 0.0;                ///< world units
  std::uint64_t tile_points = 0;       ///< about how many points a tile may have
  std::uint64_t overview_samples = 0;  ///< as in TileOptions
};

/// Makes the overviews: level after level, each of twice the spacing of the one below, in as few
/// tiles as its samples need, until one has few samples enough to be read at once. A level is
/// converted as any scan in tiles is, its points being the samples of the level below
/// (coarse_points), so that it can go on after a kill. Gives all tiles of the model, its own among
/// them, the coarsest first. Fails with one sentence.
Result<std::vector<TreePart>> make_overviews(const TiledModel& model, Progress& progress);

}  // namespace relief
