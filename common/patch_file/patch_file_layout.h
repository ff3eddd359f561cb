// Header and index of the patch file, byte by byte (docs/patch-file.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file.h"

namespace relief {

class RandomAccessFile;

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

/// Predicted integers in zstd streams (patch_codec.h).
inline constexpr std::uint16_t kCodecPredicted = 1;
/// Levels in rANS streams (compact/compact_codec.h); the only one of version 2.
inline constexpr std::uint16_t kCodecCompact = 2;

using ChunkType = std::array<char, 4>;
inline constexpr ChunkType kHeightsChunk{'H', 'G', 'H', 'T'};
inline constexpr ChunkType kNormalsChunk{'N', 'R', 'M', 'L'};
inline constexpr ChunkType kColoursChunk{'C', 'O', 'L', 'R'};

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
};

struct FileIndex {
  std::vector<PatchRecord> patches;
  std::vector<ChunkRecord> chunks;
};

struct FileLayout {
  FileHeader header;
  FileIndex index;
};

/// A range of bytes of an open file.
struct FileRange {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// Returns the CRC-32 of ISO 3309, as in gzip and PNG.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes);

/// Returns whether `bytes` have this crc32. Always true in fuzzing builds: no fuzzer gets past a
/// checksum.
[[nodiscard]] bool has_checksum(std::span<const std::byte> bytes, std::uint32_t checksum);

/// Returns what is wrong with a patch's frame or size, as a clause; empty if nothing is.
[[nodiscard]] std::string find_fault(const PatchSummary& patch);

/// Returns what is wrong with a model's spacing, bounds or radius, as a clause; empty if nothing
/// is. `bounds` may be empty.
[[nodiscard]] std::string find_fault(double spacing, const Bounds& bounds, double bounding_radius);

[[nodiscard]] std::vector<std::byte> write_header(const FileHeader& header);

/// Returns the index's bytes in the header's version. The header supplies what all patches share.
[[nodiscard]] std::vector<std::byte> write_index(const FileIndex& index, const FileHeader& header);

/// Reads and checks the header of a file of `file_bytes` bytes: its first kHeaderBytes bytes, or
/// fewer if it is shorter. Errors are sentences that begin with `name`.
Result<FileHeader> parse_header(std::span<const std::byte> bytes, std::uint64_t file_bytes,
                                const std::string& name);

/// Reads and checks the index, whose size parse_header has checked.
Result<FileIndex> parse_index(std::span<const std::byte> bytes, const FileHeader& header,
                              const std::string& name);

/// Reads and checks the header of the patch file in `range`.
Result<FileHeader> read_header(const RandomAccessFile& file, FileRange range,
                               const std::string& name);

/// Reads and checks header and index of a patch file of version 1 or 2 that is a range of an open
/// file. Offsets of chunks are relative to the open file, those of the header to the range.
Result<FileLayout> read_layout(const RandomAccessFile& file, FileRange range,
                               const std::string& name);

}  // namespace relief
