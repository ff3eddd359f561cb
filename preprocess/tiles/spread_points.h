// The points of a scan that is larger than memory, spread over tiles on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/progress.h"
#include "preprocess/tiles/scan_blocks.h"
#include "preprocess/tiles/tile_files.h"
#include "preprocess/tiles/tile_job.h"

namespace relief {

/// A scan whose points are in its tiles' files.
struct SpreadScan {
  TileLayout layout;
  std::vector<TileCount> counts;  ///< of each tile
  ScanAttributes attributes;
  Bounds bounds;
  std::optional<glm::dvec3> viewpoint;  ///< where the scanner stood, if the one file says so
  ScanCounts read;
  std::vector<std::string> notes;
};

/// What is kept of it but the notes, which the first run has told.
Status save_scan(const std::filesystem::path& path, const SpreadScan& scan);
Result<SpreadScan> load_scan(const std::filesystem::path& path);

/// The memory that a conversion of so many points at once is taken to need, bytes.
[[nodiscard]] std::uint64_t memory_for(std::uint64_t points);

struct SpreadOptions {
  std::uint64_t memory_bytes = 0;
  std::uint64_t most_tile_points = 0;
  double grid_spacing = 0.0;  ///< 0: not known yet
};

/// About how many points a tile may have.
[[nodiscard]] std::uint64_t tile_points(const SpreadOptions& options);

/// Reads the files twice: once to see where points are, once to put each into its tile. If the job
/// has that done already, nothing is read. Nothing is given if a conversion of all points at once
/// keeps to the memory. Fails if a tile has more points than the memory allows.
Result<std::optional<SpreadScan>> spread_points(const std::vector<std::filesystem::path>& files,
                                                const TileJob& job, const SpreadOptions& options,
                                                Progress& progress);

}  // namespace relief
