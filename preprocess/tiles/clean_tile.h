// Takes noise and stray points out of tiles, as clean_scan.h does of scans in one piece.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/convert_options.h"
#include "preprocess/tiles/tile_files.h"

namespace relief {

/// What cleaning found out of a tile's own points, in the order of their file and in the tiles'
/// unit. All tiles see a point as its own tile has it.
struct CleanTile {
  std::vector<std::uint8_t> stray;    ///< 1 for stray points; empty if there are none
  std::vector<glm::dvec3> positions;  ///< without noise; empty if no point moved
  std::vector<glm::vec3> normals;     ///< as in SmoothPoints
  double noise = 0.0;                 ///< standard deviation, median
  std::uint64_t moved = 0;            ///< number of points
  std::uint64_t strays = 0;           ///< number of points, duplicates merged
};

/// Finds stray points and noise of a tile's points as they were read. Meaningless if the user
/// interrupts.
[[nodiscard]] CleanTile clean_tile(TilePoints tile, const ConvertOptions& options,
                                   Progress& progress);

/// Drops stray points of a tile as it was read, and moves the others to where they are without
/// noise. `load` returns what is known of a tile: `own` for its own points, others for its halo.
Status take_clean_points(TilePoints& tile, std::uint32_t own,
                         const std::function<Result<CleanTile>(std::uint32_t tile)>& load);

Status save_clean_tile(const std::filesystem::path& path, const CleanTile& clean);
Result<CleanTile> load_clean_tile(const std::filesystem::path& path);

}  // namespace relief
