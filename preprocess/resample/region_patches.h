// Makes the patches of all regions, without those that others cover.
#pragma once

#include "preprocess/resample/resample.h"

namespace relief {

/// Returns the region of each of `points` points; the number of regions for points in none.
[[nodiscard]] std::vector<std::uint32_t> owners_of(const std::vector<Region>& regions,
                                                   std::size_t points);

/// Resamples every region; only some if the user interrupts. Then drops small patches that others
/// cover, and those without a sample, from patches and regions, so that both stay parallel.
/// `factors` multiply the spacing of each region.
[[nodiscard]] std::vector<Patch> make_patches(const ScanSurface& scan,
                                              const std::vector<double>& factors,
                                              const ResampleOptions& options,
                                              std::vector<Region>& regions, Progress& progress);

}  // namespace relief
