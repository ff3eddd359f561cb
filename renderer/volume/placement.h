// The kernels that reach into an image.
#pragma once

#include <vector>

#include "common/progress.h"
#include "renderer/view/view.h"
#include "renderer/volume/footprint.h"
#include "renderer/volume/kernel_cloud.h"
#include "renderer/volume/splat_order.h"

namespace relief {

/// The footprints of all kernels that reach into the image, in the cloud's order. Incomplete if
/// `progress` is cancelled.
[[nodiscard]] std::vector<PlacedSplat> place_splats(const KernelCloud& cloud, const View& view,
                                                    const FootprintRule& rule,
                                                    const Progress& progress);

}  // namespace relief
