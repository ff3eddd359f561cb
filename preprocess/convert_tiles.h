// Converts scans larger than memory to a patch file, tile by tile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/patch_file/patch_file.h"
#include "preprocess/convert.h"

namespace relief {

/// The smallest memory limit of a conversion in tiles.
inline constexpr std::uint64_t kMinTileMemory = std::uint64_t{256} << 20U;

struct TileOptions {
  std::uint64_t memory_bytes = kMinTileMemory;  ///< memory limit
  /// Upper limit on a tile's points at any memory limit, so that the result does not depend on
  /// memory as long as it is enough for such tiles.
  std::uint64_t max_tile_points = std::uint64_t{1} << 20U;
  bool overviews = true;  ///< coarser patches, for distant views
  /// Largest number of samples of the coarsest overview: fewer than an image has pixels, read and
  /// drawn in a few milliseconds.
  std::uint64_t overview_samples = std::uint64_t{1} << 16U;
};

/// Result of a conversion in tiles.
struct TiledResult {
  ConvertReport report;  ///< `normals_repaired` counts the points near tiles' borders for each tile
  std::uint64_t nonfinite = 0;   ///< points dropped
  std::uint64_t left_out = 0;    ///< points marked as withheld or noise (LAS)
  std::uint64_t duplicates = 0;  ///< points merged
  std::uint64_t tiles = 0;
  std::uint64_t halo_points = 0;   ///< points of other tiles in halos, over all tiles
  std::uint64_t tiles_found = 0;   ///< finished by an earlier run
  std::vector<std::string> notes;  ///< for the user, a sentence each
};

/// Converts the points of files, which are parts of one scan, and writes the patch file. Returns
/// nothing if the points fit into memory: use convert() then, which also handles triangles and
/// textures.
///
/// The scan is cut into tiles, each with a halo of its neighbours' points; patches end at tile
/// borders and overlap there as everywhere. Overviews are tiles of coarser patches
/// (common/patch_file/patch_tree.h). Finished parts are kept in the folder `output`.parts until the
/// end. An interrupted or killed conversion continues from there if it is started again with equal
/// files, options and program, and gives identical bytes. The bytes depend neither on the number of
/// threads nor on memory, if it is enough for the largest tiles. Fails with one sentence.
Result<std::optional<TiledResult>> convert_tiles(const std::vector<std::filesystem::path>& files,
                                                 const std::filesystem::path& output,
                                                 const ConvertOptions& options,
                                                 const PatchFileOptions& file_options,
                                                 const TileOptions& tile_options,
                                                 Progress& progress);

/// Returns the folder of an unfinished conversion to `output`; nothing if there is none.
[[nodiscard]] std::optional<std::filesystem::path> find_kept_tiles(
    const std::filesystem::path& output);

}  // namespace relief
