// Distributes the points of a scan larger than memory to tiles on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/progress.h"
#include "preprocess/frame/working_frame.h"
#include "preprocess/tiles/scan_blocks.h"
#include "preprocess/tiles/tile_files.h"
#include "preprocess/tiles/tile_job.h"

namespace relief {

/// A scan with its points in tile files: in a unit and a frame of their own, as `convert` has them.
struct SpreadScan {
  double unit = 1.0;   ///< world units
  WorkingFrame frame;  ///< in that unit
  TileLayout layout;
  std::vector<TileCount> counts;  ///< one for each tile
  ScanAttributes attributes;
  Bounds bounds;  ///< world frame
  /// Position of the scanner, if the scan's only file gives it; as the points.
  std::optional<glm::dvec3> viewpoint;
  Stance stance;                   ///< of the last file
  bool is_airborne = false;        ///< all files
  std::vector<glm::dvec3> sample;  ///< some points of all tiles, as these, chosen by chance
  ScanCounts read;
  std::vector<std::string> notes;
};

/// Moves points from the world to the tiles' unit and frame.
void to_tiles(const SpreadScan& scan, Points& points);

/// The checkpoint of a scan. Without the notes, which the first run has reported.
Status save_scan(const std::filesystem::path& path, const SpreadScan& scan);
Result<SpreadScan> load_scan(const std::filesystem::path& path);

/// Returns the memory that a conversion of this many points at once is assumed to need, bytes.
/// `scalars`: how many each point has.
[[nodiscard]] std::uint64_t memory_for(std::uint64_t points, std::size_t scalars = 0);

struct SpreadOptions {
  std::uint64_t memory_bytes = 0;
  std::uint64_t max_tile_points = 0;
  double grid_spacing = 0.0;  ///< 0: not yet known
  ReadOptions read = {};      ///< how the files are read
};

/// Returns the approximate limit of points a tile, with this many scalars each.
[[nodiscard]] std::uint64_t tile_points(const SpreadOptions& options, std::size_t scalars);

/// Reads the files twice: once to lay out tiles, once to write each point to its tile. Reads
/// nothing if the job has already done this. Returns nothing if a conversion of all points at once
/// fits into the memory limit. Fails if a tile has more points than the limit allows.
Result<std::optional<SpreadScan>> spread_points(const std::vector<std::filesystem::path>& files,
                                                const TileJob& job, const SpreadOptions& options,
                                                Progress& progress);

}  // namespace relief
