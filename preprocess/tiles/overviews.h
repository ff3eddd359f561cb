// Makes overviews: tiles of coarser patches of a large model, for distant views.
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

/// The tiles of a job, and how their patches were made.
struct TiledModel {
  std::string name;  ///< of the scan's first file; begins errors
  const TileJob& job;
  const SpreadScan& scan;
  const ConvertOptions& options;
  const PatchFileOptions& file_options;
  double spacing = 0.0;                ///< world units
  std::uint64_t tile_points = 0;       ///< approximate limit of points a tile
  std::uint64_t overview_samples = 0;  ///< as in TileOptions
};

/// Makes the overviews: level after level, each of twice the spacing of the one below and in as few
/// tiles as possible, until one has few enough samples to be read at once. A level is converted
/// like any scan in tiles, from the samples of the level below (coarse_points), so that it also
/// continues after a kill. Returns all tiles of the model, those of level 0 included, the coarsest
/// first. Fails with one sentence.
Result<std::vector<TreePart>> make_overviews(const TiledModel& model, Progress& progress);

}  // namespace relief
