// The patches of a tile in chunks, which are read, uploaded and dropped as one.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/patch_file/patch_file.h"

namespace relief {

/// Grid nodes of a chunk, unless a patch has more: about 65,000 samples, which take 39 to 77 ms to
/// read and prepare, and 1 ms to upload (llvmpipe).
inline constexpr std::uint64_t kChunkNodes = 131'072;

/// A chunk of a file.
struct ChunkKey {
  std::uint32_t tile = 0;   ///< in PatchTree::tiles()
  std::uint32_t chunk = 0;  ///< in TileIndex::chunks

  bool operator==(const ChunkKey&) const = default;
  bool operator<(const ChunkKey& other) const {
    return tile != other.tile ? tile < other.tile : chunk < other.chunk;
  }
};

struct ChunkInfo {
  std::vector<std::uint32_t> patches;  ///< of the tile
  Bounds box;                          ///< about their samples, file frame
  double spacing = 0.0;                ///< of the coarsest
  std::uint64_t nodes = 0;
  std::uint64_t samples = 0;
  bool is_joined = false;  ///< its patches meet at seams
};

struct TileIndex {
  std::vector<ChunkInfo> chunks;
};

/// Sorts the patches of a tile that have samples into chunks of neighbours. Those that meet at
/// seams (`are_joined`) stay together.
[[nodiscard]] TileIndex index_tile(std::span<const PatchSummary> patches, bool are_joined);

}  // namespace relief
