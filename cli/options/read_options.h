// Options about reading scans: the format, and which points are read.
#pragma once

#include <CLI/App.hpp>

#include "preprocess/readers/selection.h"

namespace relief::cli {

/// Declares --format, --classes, --returns and --crop, which fill `options`. It must outlive `sub`.
void add_read_options(CLI::App& sub, ReadOptions& options);

}  // namespace relief::cli
