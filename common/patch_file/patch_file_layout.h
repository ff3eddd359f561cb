// Header and index of the patch file, byte by byte (docs/patch-file.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/io/crc32.h"
#include "common/patch_file/patch_file_records.h"

namespace relief {

class RandomAccessFile;

/// A range of bytes of an open file.
struct FileRange {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// Whether the bytes begin as a patch file does.
[[nodiscard]] bool has_magic(std::span<const std::byte> bytes);

[[nodiscard]] std::vector<std::byte> write_header(const FileHeader& header);

/// Returns the index's bytes in the header's version. The header supplies what all patches share.
[[nodiscard]] std::vector<std::byte> write_index(const FileIndex& index, const FileHeader& header);

/// Reads and checks the header of a file of `file_bytes` bytes: its first kHeaderBytes bytes, or
/// fewer if it is shorter. Leaves FileHeader::block empty. Errors are sentences that begin with
/// `name`.
Result<FileHeader> parse_header(std::span<const std::byte> bytes, std::uint64_t file_bytes,
                                const std::string& name);

/// Reads and checks the index, whose size parse_header has checked.
Result<FileIndex> parse_index(std::span<const std::byte> bytes, const FileHeader& header,
                              const std::string& name);

/// Reads and checks the header of the patch file in `range`, and its model block.
Result<FileHeader> read_header(const RandomAccessFile& file, FileRange range,
                               const std::string& name);

/// Reads and checks header and index of a patch file of version 1 or 2 that is a range of an open
/// file. Offsets of chunks are relative to the open file, those of the header to the range.
Result<FileLayout> read_layout(const RandomAccessFile& file, FileRange range,
                               const std::string& name);

}  // namespace relief
