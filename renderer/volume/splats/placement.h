// The kernels that reach into an image.
#pragma once

#include <span>
#include <vector>

#include "common/progress.h"
#include "renderer/view/view.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/splats/footprint.h"
#include "renderer/volume/splats/splat_order.h"

namespace relief {

/// The footprints of all kernels that reach into the image, in the cloud's order. `rules`: of each
/// part of the cloud. Incomplete if `progress` is cancelled.
[[nodiscard]] std::vector<PlacedSplat> place_splats(const KernelCloud& cloud, const View& view,
                                                    std::span<const FootprintRule> rules,
                                                    const Progress& progress);

}  // namespace relief
