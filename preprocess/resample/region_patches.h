// All regions of a scan become patches, and those that others cover go.
#pragma once

#include "preprocess/resample/resample.h"

namespace relief {

/// Which region each of `points` points is in; the number of regions where it is in none.
[[nodiscard]] std::vector<std::uint32_t> owners_of(const std::vector<Region>& regions,
                                                   std::size_t points);

/// Resamples every region; in part if the user interrupts. Then drops small patches that others
/// cover, and those without a sample, with their regions: what is left stands side by side.
/// `membership` of all points; `factors` on the spacing, of each region; `colours` is empty or one
/// per point.
[[nodiscard]] std::vector<Patch> make_patches(
    const SurfaceSamples& samples, const NeighbourGraph& graph, const Membership& membership,
    const std::vector<double>& factors, const std::vector<glm::u8vec3>& colours,
    const ResampleOptions& options, std::vector<Region>& regions, Progress& progress);

}  // namespace relief
