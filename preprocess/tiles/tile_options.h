// Options and report of a conversion in tiles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/convert_options.h"
#include "preprocess/readers/selection.h"

namespace relief {

/// The smallest memory limit of a conversion in tiles.
inline constexpr std::uint64_t kMinTileMemory = std::uint64_t{256} << 20U;

struct TileOptions {
  std::uint64_t memory_bytes = kMinTileMemory;  ///< memory limit
  /// Upper limit on a tile's points, which every memory limit has room for, so that the result does
  /// not depend on it. Small tiles are what a view can be fine in near the eye and coarse far away
  /// (docs/decisions/0041).
  std::uint64_t max_tile_points = std::uint64_t{1} << 17U;
  bool overviews = true;  ///< coarser patches, for distant views
  /// Largest number of samples of the coarsest overview: fewer than an image has pixels, read and
  /// drawn in a few milliseconds.
  std::uint64_t overview_samples = std::uint64_t{1} << 16U;
  ReadOptions read = {};  ///< how the files are read
};

/// Result of a conversion in tiles.
struct TiledResult {
  ConvertReport report;  ///< `normals_repaired` counts the points near tiles' borders for each tile
  std::uint64_t nonfinite = 0;     ///< points dropped
  std::uint64_t left_out = 0;      ///< points marked as withheld or noise (LAS)
  std::uint64_t not_selected = 0;  ///< points that TileOptions::read does not select
  std::uint64_t duplicates = 0;    ///< points merged
  std::uint64_t tiles = 0;
  std::uint64_t halo_points = 0;   ///< points of other tiles in halos, over all tiles
  std::uint64_t tiles_found = 0;   ///< finished by an earlier run
  std::vector<std::string> notes;  ///< for the user, a sentence each
};

}  // namespace relief
