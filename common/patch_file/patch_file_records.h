// The header and the records of the patch file in memory, and their sizes in the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/patch_file/model_block.h"
#include "common/patch_file/patch_file.h"

namespace relief {

/// Version 1 has an index of fixed records, version 2 a compact index (compact/compact_index.h).
/// Version 3 has tiles, each a complete file of version 1 or 2 (patch_tree_layout.h).
inline constexpr std::uint32_t kPlainVersion = 1;
inline constexpr std::uint32_t kCompactVersion = 2;
inline constexpr std::uint32_t kTreeVersion = 3;
inline constexpr std::size_t kHeaderBytes = 128;
inline constexpr std::size_t kPatchRecordBytes = 144;
inline constexpr std::size_t kChunkRecordBytes = 24;
inline constexpr std::size_t kTileRecordBytes = 84;

/// The header's flags; readers ignore unknown ones.
inline constexpr std::uint64_t kClosedFlag = 1;
inline constexpr std::uint64_t kJoinedFlag = 2;
inline constexpr std::uint64_t kBorderlessFlag = 4;  ///< also where the surface is not closed
inline constexpr std::uint64_t kPointsFlag = 8;      ///< PatchModel::is_of_points
/// The upper half of the flags is the size of the model block, bytes.
inline constexpr unsigned kBlockSizeShift = 32;

/// Predicted integers in zstd streams (patch_codec.h).
inline constexpr std::uint16_t kCodecPredicted = 1;
/// Levels in rANS streams (compact/compact_codec.h); the only one of version 2.
inline constexpr std::uint16_t kCodecCompact = 2;

using ChunkType = std::array<char, 4>;
inline constexpr ChunkType kHeightsChunk{'H', 'G', 'H', 'T'};
inline constexpr ChunkType kNormalsChunk{'N', 'R', 'M', 'L'};
inline constexpr ChunkType kColoursChunk{'C', 'O', 'L', 'R'};
inline constexpr ChunkType kScalarChunk{'S', 'C', 'L', 'R'};  ///< one for each of the model block

/// Position and coding of a chunk's bytes.
struct ChunkRecord {
  ChunkType type{};
  std::uint16_t codec = kCodecPredicted;
  std::uint16_t scale = 1;  ///< texels per cell of an attribute map
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  std::uint32_t checksum = 0;  ///< see crc32
};

/// A patch's entry in the index: its summary and its chunks.
struct PatchRecord {
  PatchSummary summary;
  std::uint32_t first_chunk = 0;
  std::uint32_t chunk_count = 0;
};

/// In version 3 the counts are those of the tiles of level 0, and `chunks` counts tiles.
struct FileHeader {
  std::uint32_t version = kPlainVersion;
  std::uint64_t file_bytes = 0;
  std::uint64_t index_offset = 0;
  std::uint32_t patches = 0;
  std::uint32_t chunks = 0;
  std::uint32_t index_checksum = 0;
  std::uint64_t samples = 0;
  double spacing = 0.0;
  Bounds bounds;
  double bounding_radius = 0.0;
  bool is_closed = false;
  bool is_joined = false;
  bool is_borderless = false;  ///< PatchRun::is_closed of patches that meet
  bool is_of_points = false;
  std::uint32_t block_bytes = 0;  ///< of the model block, which follows the header
  ModelBlock block;               ///< set by read_header

  /// Where chunks or tiles begin.
  [[nodiscard]] std::uint64_t data_offset() const { return kHeaderBytes + block_bytes; }
};

struct FileIndex {
  std::vector<PatchRecord> patches;
  std::vector<ChunkRecord> chunks;
};

struct FileLayout {
  FileHeader header;
  FileIndex index;
  std::vector<PatchRun> joined;  ///< as in PatchModel: all patches, or those of each tile
};

}  // namespace relief
