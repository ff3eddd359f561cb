// Files as bytes: reading with one clear sentence on failure, writing that never leaves half a
// file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <vector>

#include "common/error.h"

namespace relief {

/// Reads a whole file. Says what is wrong with a missing file, a directory, an unreadable or empty
/// one.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

/// Writes `bytes` to a temporary file in the same directory and renames it to `path`. On any
/// failure (no such directory, `path` is a directory, disk full) the temporary file is removed, an
/// older `path` stays as it was and one sentence says what happened.
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace relief
