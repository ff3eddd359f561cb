// A patch file of any size, tile by tile: what is far away is read coarsely, what is not seen not
// at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file.h"

namespace relief {

/// The parent of a tile that has none.
inline constexpr std::uint32_t kNoTile = std::numeric_limits<std::uint32_t>::max();

/// A region's patches. Tiles of level 0 have the model's own patches; one of a higher level shows
/// what its children show, which are tiles of the level below, by fewer and larger samples.
struct TreeTile {
  std::uint64_t offset = 0;  ///< where it lies in the file
  std::uint64_t bytes = 0;
  std::uint64_t samples = 0;
  std::uint32_t patches = 0;
  std::uint32_t parent = kNoTile;  ///< an earlier tile
  std::uint32_t level = 0;
  double spacing = 0.0;  ///< of its samples, world units
  Bounds box;            ///< about its samples, world; empty if it has none
};

/// An open patch file of which only the list of tiles is in memory. A file that has no tiles (of
/// version 1 or 2) is a single one.
class PatchTree {
 public:
  /// Opens and checks header and tiles, and fails as PatchFile::open() does.
  static Result<PatchTree> open(const std::filesystem::path& path);

  /// Coarse ones before their children. Every sample of the model is in one of level 0.
  [[nodiscard]] const std::vector<TreeTile>& tiles() const { return tiles_; }

  /// The model's spacing, bounds and sphere, whether it is closed; no patches.
  [[nodiscard]] const PatchModel& extent() const { return extent_; }

  /// Opens a tile's patches: reads their index. Thread-safe.
  [[nodiscard]] Result<PatchFile> open_tile(std::uint32_t tile) const;

 private:
  PatchTree() = default;

  std::filesystem::path path_;
  PatchModel extent_;
  std::vector<TreeTile> tiles_;
};

/// A patch file that becomes a tile.
struct TreePart {
  std::filesystem::path path;  ///< a file of version 1 or 2, of one spacing
  std::uint32_t level = 0;
  std::uint32_t parent = kNoTile;  ///< its number in the list; it comes earlier
};

/// Writes a file of these tiles, beside and renamed. `extent`: the model's spacing, bounds and
/// sphere. Tiles are copied as they are; little more than an index is in memory. Fails with one
/// sentence.
Status write_patch_tree(const std::filesystem::path& path, const std::vector<TreePart>& parts,
                        const PatchModel& extent);

}  // namespace relief
