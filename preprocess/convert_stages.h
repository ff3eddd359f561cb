// What a conversion in memory and one in tiles decide alike.
#pragma once

#include <vector>

#include "preprocess/convert.h"
#include "preprocess/resample/resample.h"

namespace relief {

/// Refuses a spacing whose grids over this area (world units squared) would have far more nodes
/// than the scan has points.
Status check_spacing(double spacing, double area, std::uint64_t points);

/// How regions are resampled at a spacing that was given or chosen.
[[nodiscard]] ResampleOptions resample_options(const ConvertOptions& options, double spacing,
                                               bool normals_estimated);

/// Adds the texels of some patches to a report.
void count_texels(const std::vector<Patch>& patches, ConvertReport& report);

}  // namespace relief
