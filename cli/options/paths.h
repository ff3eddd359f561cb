// Paths that the user names, checked before any long work starts.
#pragma once

#include <filesystem>
#include <vector>

#include "common/error.h"

namespace relief::cli {

/// Checks that a file can be written at `path`: its directory exists and is writable, `path` is not
/// one of `inputs`, and is not an existing file of another kind than a regular one.
Status check_output(const std::filesystem::path& path,
                    const std::vector<std::filesystem::path>& inputs);

}  // namespace relief::cli
