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

/// Version 1 has an index of fixed records, version 2 a compact one (compact/compact_index.h).
/// Version 3 has tiles, each a file of version 1 or 2 in itself (patch_tree_layout.h).
inline constexpr std::uint32_t kPlainVersion = 1;
inline constexpr std::uint32_t kCompactVersion = 2;
inline constexpr std::uint32_t kTreeVersion = 3;
inline constexpr std::size_t kHeaderBytes = 128;
inline constexpr std::size_t kPatchRecordBytes = 144;
inline constexpr std::size_t kChunkRecordBytes = 24;
inline constexpr std::size_t kTileRecordBytes = 84;

/// The header's flags; a reader passes over those that it does not know.
inline constexpr std::uint64_t kClosedFlag = 1;

/// Predicted integers in zstd streams (patch_codec.h).
inline constexpr std::uint16_t kCodecPredicted = 1;
/// Levels in rANS streams (compact/compact_codec.h); the only one of version 2.
inline constexpr std::uint16_t kCodecCompact = 2;

using ChunkType = std::array<char, 4>;
inline constexpr ChunkType kHeightsChunk{'H', 'G', 'H', 'T'};
inline constexpr ChunkType kNormalsChunk{'N', 'R', 'M', 'L'};
inline constexpr ChunkType kColoursChunk{'C', 'O', 'L', 'R'};

/// Where a chunk's bytes lie and how they are coded.
struct ChunkRecord {
  ChunkType type{};
  std::uint16_t codec = kCodecPredicted;
  std::uint16_t scale = 1;  ///< texels per cell of an attribute map
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  std::uint32_t checksum = 0;  ///< see crc32
};

/// A patch's line of the index: its summary and which of the chunks are its own.
struct PatchRecord {
  PatchSummary summary;
  std::uint32_t first_chunk = 0;
  std::uint32_t chunk_count = 0;
};

/// What there is of version 3 is that of its tiles of level 0; in place of chunks it counts tiles.
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

/// Bytes of an open file.
struct FileRange {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// CRC-32 of ISO 3309, as in gzip and PNG.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes);

/// Whether `bytes` have this crc32. Where the fuzz targets are built they always have: no fuzzer
/// gets past a checksum.
[[nodiscard]] bool has_checksum(std::span<const std::byte> bytes, std::uint32_t checksum);

/// What speaks against a patch's placement or size, as a clause; empty if nothing does.
[[nodiscard]] std::string find_fault(const PatchSummary& patch);

/// What speaks against a model's spacing, bounds or radius, as a clause; empty if nothing does.
/// `bounds` may be empty.
[[nodiscard]] std::string find_fault(double spacing, const Bounds& bounds, double bounding_radius);

[[nodiscard]] std::vector<std::byte> write_header(const FileHeader& header);

/// The index in the header's version, of which it takes what patches have in common.
[[nodiscard]] std::vector<std::byte> write_index(const FileIndex& index, const FileHeader& header);

/// Reads and checks the first kHeaderBytes bytes (or what there is) of a file of `file_bytes`
/// bytes. Errors are whole sentences that start with `name`.
Result<FileHeader> parse_header(std::span<const std::byte> bytes, std::uint64_t file_bytes,
                                const std::string& name);

/// Reads and checks the index, whose size was found right by parse_header.
Result<FileIndex> parse_index(std::span<const std::byte> bytes, const FileHeader& header,
                              const std::string& name);

/// Reads and checks the header of what begins at `range`, a whole patch file.
Result<FileHeader> read_header(const RandomAccessFile& file, FileRange range,
                               const std::string& name);

/// Reads and checks header and index of a patch file of version 1 or 2 that is a range of an open
/// file. Offsets of chunks are those in the open file; the header's are of the range.
Result<FileLayout> read_layout(const RandomAccessFile& file, FileRange range,
                               const std::string& name);

}  // namespace relief
