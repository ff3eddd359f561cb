// Takes the noise out of the points of tiles.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/tiles/tile_files.h"

namespace relief {

/// A tile's own points without noise, in the order of its file and in its unit. All tiles see a
/// point where its own tile has it.
struct TileNoise {
  std::vector<glm::dvec3> positions;  ///< empty if no point moved
  std::vector<glm::vec3> normals;     ///< as in SmoothPoints
  double noise = 0.0;                 ///< standard deviation, median
  std::uint64_t moved = 0;            ///< points
};

/// Finds where a tile's own points are without noise, of its points as they were read. `given`: as
/// for remove_noise. Meaningless if the user interrupts.
[[nodiscard]] TileNoise find_tile_noise(TilePoints tile, std::optional<double> given,
                                        Progress& progress);

/// Moves a tile's points, as they were read, to where they are without noise. `load` returns the
/// noise of a tile: `own` for its own points, others for those of its halo.
Status move_tile_points(TilePoints& tile, std::uint32_t own,
                        const std::function<Result<TileNoise>(std::uint32_t tile)>& load);

Status save_noise(const std::filesystem::path& path, const TileNoise& noise);
Result<TileNoise> load_noise(const std::filesystem::path& path);

}  // namespace relief
