// The index of version 2 of the patch file: about 40 bytes a patch instead of 192
// (docs/patch-file.md, "The index of version 2").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file_records.h"

namespace relief {

/// The smallest size of a patch's index entry, in bytes.
inline constexpr std::size_t kMinCompactRecord = 28;

/// Positions are rounded to steps of a power of two, at most a 16th of any patch's height step, so
/// that no sample moves by more than 0.06 height steps. Normal cones still hold all their normals.
/// Chunks follow the header one after another, each patch's heights first.
[[nodiscard]] std::vector<std::byte> write_compact_index(const FileIndex& index,
                                                         const FileHeader& header);

/// Reads and checks the index, whose checksum is already checked. Errors are sentences that begin
/// with `name`.
Result<FileIndex> parse_compact_index(std::span<const std::byte> bytes, const FileHeader& header,
                                      const std::string& name);

}  // namespace relief
