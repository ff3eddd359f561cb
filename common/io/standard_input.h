// Standard input as a file: the path "-".
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"

namespace relief {

/// The name of standard input, and of standard output.
inline constexpr const char* kStandardName = "-";

/// Returns the path to open for an input: that of standard input for "-", otherwise `path`.
[[nodiscard]] std::filesystem::path input_path(const std::filesystem::path& path);

/// Makes standard input a regular file, which can be opened, measured and mapped as every other: a
/// pipe is copied to a file without a name in the folder for temporary files, and takes the pipe's
/// place in this process. Call it once, before "-" is opened. Fails if standard input is a terminal
/// or closed, if the disk is full, or if the user interrupts.
Status spool_standard_input(Progress& progress);

}  // namespace relief
