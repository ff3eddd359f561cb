// The index of version 3 of the patch file: tiles, each a patch file in itself, and coarser tiles
// over them (docs/patch-file.md, "Version 3: tiles").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file_layout.h"
#include "common/patch_file/patch_tree.h"

namespace relief {

/// More levels than spacings can double from anything to anything else.
inline constexpr std::uint32_t kMostTreeLevels = 64;

[[nodiscard]] std::vector<std::byte> write_tree_index(std::span<const TreeTile> tiles);

/// Reads and checks the index of a file of version 3 whose header was found right. Errors are whole
/// sentences that start with `name`.
Result<std::vector<TreeTile>> parse_tree_index(std::span<const std::byte> bytes,
                                               const FileHeader& header, const std::string& name);

/// Reads header and tiles of an open file. One of version 1 or 2 is one tile.
struct TreeLayout {
  FileHeader header;
  std::vector<TreeTile> tiles;
};
Result<TreeLayout> read_tree_layout(const RandomAccessFile& file, const std::string& name);

/// Reads a tile's header and index, as read_layout does, and whether they are what the list of
/// tiles says: others rely on that without opening the tile.
Result<FileLayout> read_tile(const RandomAccessFile& file, const TreeTile& tile,
                             const std::string& name);

/// Reads the header, and the index of the model's own patches: of all tiles of level 0 together.
Result<FileLayout> read_own_layout(const RandomAccessFile& file, const std::string& name);

/// The box about all samples that an index tells of.
[[nodiscard]] Bounds box_of(const FileIndex& index);

}  // namespace relief
