// The index of version 3 of the patch file: tiles, each a patch file in itself, and coarser tiles
// over them (docs/patch-file.md, "Version 3: tiles").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file_layout.h"
#include "common/patch_file/tree_tile.h"

namespace relief {

/// More levels than the range of spacings allows.
inline constexpr std::uint32_t kMaxTreeLevels = 64;

[[nodiscard]] std::vector<std::byte> write_tree_index(std::span<const TreeTile> tiles);

/// Reads and checks the index of a file of version 3 with a checked header. Errors are sentences
/// that begin with `name`.
Result<std::vector<TreeTile>> parse_tree_index(std::span<const std::byte> bytes,
                                               const FileHeader& header, const std::string& name);

/// Reads the header and tiles of an open file. A file of version 1 or 2 is one tile.
struct TreeLayout {
  FileHeader header;
  std::vector<TreeTile> tiles;
};
Result<TreeLayout> read_tree_layout(const RandomAccessFile& file, const std::string& name);

/// Reads a tile's header and index, as read_layout does, and checks that they agree with the list
/// of tiles, on which others rely without opening the tile.
Result<FileLayout> read_tile(const RandomAccessFile& file, const TreeTile& tile,
                             const std::string& name);

/// Reads the header, and the index of the model's own patches: of all tiles of level 0 together.
Result<FileLayout> read_own_layout(const RandomAccessFile& file, const std::string& name);

/// Returns the box about all samples of an index.
[[nodiscard]] Bounds box_of(const FileIndex& index);

}  // namespace relief
