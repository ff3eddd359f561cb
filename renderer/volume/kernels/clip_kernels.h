// Leaves out the kernels outside of a box.
#pragma once

#include "common/bounds.h"
#include "renderer/volume/kernels/kernel_cloud.h"

namespace relief {

/// Keeps the kernels whose centres lie in the box, its sides included, in their order. Those of
/// weight Peak stay in their places with weight 0, because colours are made for all Gaussians.
void clip_kernels(KernelCloud& cloud, const Bounds& box);

}  // namespace relief
