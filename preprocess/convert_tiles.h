// Converts scans larger than memory to a patch file, tile by tile.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/patch_file/patch_file.h"
#include "common/progress.h"
#include "preprocess/tiles/tile_options.h"

namespace relief {

/// Converts the points of files, which are parts of one scan, and writes the patch file. Returns
/// nothing if the points fit into memory: use convert() then, which also handles triangles and
/// textures.
///
/// The scan is cut into tiles, each with a halo of its neighbours' points; patches end at tile
/// borders and overlap there, also if they meet at seams within each tile. Overviews are tiles of
/// coarser patches (common/patch_file/patch_tree.h). Finished parts are kept in the folder
/// `output`.parts until the end. An interrupted or killed conversion continues from there if it is
/// started again with equal files, options and program, and gives identical bytes. The bytes depend
/// neither on the number of threads nor on memory, if it is enough for the largest tiles. Fails
/// with one sentence.
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
