// From points that are more than memory holds to a patch file, tile by tile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/patch_file/patch_file.h"
#include "preprocess/convert.h"

namespace relief {

/// The least memory that a conversion in tiles can be told to keep to.
inline constexpr std::uint64_t kLeastTileMemory = std::uint64_t{256} << 20U;

struct TileOptions {
  std::uint64_t memory_bytes = kLeastTileMemory;  ///< to keep to
  /// Larger tiles are not made, whatever the memory: so the result is the same with any memory
  /// that is enough for these.
  std::uint64_t most_tile_points = std::uint64_t{1} << 20U;
  bool overviews = true;  ///< coarser patches, for viewers that are far away
  /// The coarsest overview has at most so many: less than a picture has pixels, read and drawn in a
  /// few milliseconds.
  std::uint64_t overview_samples = std::uint64_t{1} << 16U;
};

/// What a conversion in tiles made.
struct TiledResult {
  ConvertReport report;  ///< `normals_repaired` counts the points near tiles' borders for each tile
  std::uint64_t nonfinite = 0;   ///< points dropped
  std::uint64_t left_out = 0;    ///< points marked as withheld or noise (LAS)
  std::uint64_t duplicates = 0;  ///< points merged
  std::uint64_t tiles = 0;
  std::uint64_t halo_points = 0;   ///< that tiles have of others, all in all
  std::uint64_t tiles_found = 0;   ///< that an earlier run had finished
  std::vector<std::string> notes;  ///< what the user should hear of, a sentence each
};

/// Converts the points of some files, parts of one scan, and writes the patch file. Nothing if they
/// fit into memory: then convert() is to be used, which also takes triangles and textures.
///
/// The scan is cut into tiles, each with a halo of its neighbours' points; patches end at tiles'
/// borders and overlap there as they do everywhere. Over them come overviews, tiles of coarser
/// patches (common/patch_tree.h). What is done is kept in the folder
/// `output`.parts until the end: a conversion that was interrupted or killed goes on from there
/// when it is started again with the same files, options and program, and gives the same bytes.
/// Those depend neither on threads nor, if it is enough for the largest tiles, on memory. Fails
/// with one sentence.
Result<std::optional<TiledResult>> convert_tiles(const std::vector<std::filesystem::path>& files,
                                                 const std::filesystem::path& output,
                                                 const ConvertOptions& options,
                                                 const PatchFileOptions& file_options,
                                                 const TileOptions& tile_options,
                                                 Progress& progress);

/// Where a conversion to `output` left something to go on from; nothing if it did not.
[[nodiscard]] std::optional<std::filesystem::path> find_kept_tiles(
    const std::filesystem::path& output);

}  // namespace relief
