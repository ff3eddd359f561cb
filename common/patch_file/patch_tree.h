// Patch files of any size, tile by tile: distant tiles are read coarsely, invisible tiles not at
// all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file.h"
#include "common/patch_file/tree_tile.h"

namespace relief {

/// An open patch file with only the list of tiles in memory. A file without tiles (version 1 or 2)
/// is a single tile.
class PatchTree {
 public:
  /// Opens a file and checks its header and list of tiles. Fails as PatchFile::open() does.
  static Result<PatchTree> open(const std::filesystem::path& path);

  /// The tiles, parents before their children. Every sample of the model is in a tile of level 0.
  [[nodiscard]] const std::vector<TreeTile>& tiles() const { return tiles_; }

  /// The model's spacing, bounds, sphere and scalars, and whether it is closed; without patches.
  [[nodiscard]] const PatchModel& extent() const { return extent_; }

  /// Opens a tile's patches: reads their index. Thread-safe.
  [[nodiscard]] Result<PatchFile> open_tile(std::uint32_t tile) const;

 private:
  PatchTree() = default;

  std::filesystem::path path_;
  PatchModel extent_;
  std::vector<TreeTile> tiles_;
};

/// A patch file that becomes a tile of a larger one.
struct TreePart {
  std::filesystem::path path;  ///< a file of version 1 or 2, of one spacing
  std::uint32_t level = 0;
  std::uint32_t parent = kNoTile;  ///< index of an earlier part
};

/// Writes a file of these tiles, atomically. `extent`: the model's spacing, bounds, sphere and
/// scalars, which are those of each tile.
/// Tiles are copied unchanged; memory holds little more than an index. Fails with one sentence.
Status write_patch_tree(const std::filesystem::path& path, const std::vector<TreePart>& parts,
                        const PatchModel& extent);

}  // namespace relief
