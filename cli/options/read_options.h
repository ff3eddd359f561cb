// Options about reading scans: the format, and which points are read.
#pragma once

#include <CLI/App.hpp>

#include "preprocess/readers/selection.h"
#include "preprocess/volumes/read_volume.h"

namespace relief::cli {

/// Declares --format, --classes, --returns and --crop, which fill `options`. It must outlive `sub`.
void add_read_options(CLI::App& sub, ReadOptions& options);

/// Declares --raw, the layout of a volume without a header, which fills `options`. It must outlive
/// `sub`.
void add_raw_option(CLI::App& sub, VolumeReadOptions& options);

/// Declares --volume-scalar, the scalar of points that are a volume, which fills `options`. It must
/// outlive `sub`, which has --raw.
void add_volume_scalar_option(CLI::App& sub, VolumeReadOptions& options);

}  // namespace relief::cli
