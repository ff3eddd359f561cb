// Decisions that conversion in memory and conversion in tiles share.
#pragma once

#include <vector>

#include "common/error.h"
#include "preprocess/convert_options.h"
#include "preprocess/resample/resample.h"

namespace relief {

/// Fails if grids of this spacing over this area (world units squared) would have far more nodes
/// than the scan has points.
Status check_spacing(double spacing, double area, std::uint64_t points);

/// Fails if `spacing` is more than the diagonal of the scan's bounds: then no sample has a
/// neighbour.
Status check_spacing(double spacing, const Bounds& scan);

/// Returns the options for resampling regions at a given or chosen spacing.
[[nodiscard]] ResampleOptions resample_options(const ConvertOptions& options, bool seams,
                                               double spacing, NormalSource normals);

/// Returns where samples take their normals from. `are_given`: the scan has normals; `is_moved`:
/// its noise was removed.
[[nodiscard]] NormalSource source_of_normals(bool are_given, bool is_moved);

/// Adds the texel counts of the patches to a report.
void count_texels(const std::vector<Patch>& patches, ConvertReport& report);

}  // namespace relief
