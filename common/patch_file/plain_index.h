// The index of version 1 of the patch file: records of fixed size (docs/patch-file.md, "Patch
// record" and "Chunk record").
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch_file/patch_file_records.h"

namespace relief {

[[nodiscard]] std::vector<std::byte> write_plain_index(const FileIndex& index);

/// Reads and checks the index, whose checksum and size are already checked. Errors are sentences
/// that begin with `name`.
Result<FileIndex> parse_plain_index(std::span<const std::byte> bytes, const FileHeader& header,
                                    const std::string& name);

}  // namespace relief
