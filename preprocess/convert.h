// Converts points to patches: the preprocessing of [Ochotta 2008], section 3.1.
#pragma once

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/convert_options.h"

namespace relief {

/// Converts cleaned points (see clean_points) to patches. A mesh whose triangles have materials
/// (load_textures) is sampled first, and its patches get maps of its textures. Fails with one
/// sentence if there are too few points or they span no surface (all equal, all on one line), or if
/// the user interrupts.
Result<ConvertResult> convert(Points points, const ConvertOptions& options, Progress& progress);

}  // namespace relief
