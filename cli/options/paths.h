// Paths that the user names, checked before any long work starts.
#pragma once

#include <filesystem>
#include <vector>

#include "common/error.h"

namespace relief::cli {

/// Whether a file can be written at `path`: its directory exists and is writable, `path` is none of
/// the `inputs` and nothing but a regular file stands there.
Status check_output(const std::filesystem::path& path,
                    const std::vector<std::filesystem::path>& inputs);

}  // namespace relief::cli
