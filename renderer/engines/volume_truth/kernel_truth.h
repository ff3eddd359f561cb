// The sum of a volume's kernels, attenuated along every ray.
#pragma once

#include "common/progress.h"
#include "renderer/engines/volume_truth/node_kernels.h"
#include "renderer/engines/volume_truth/sample_image.h"

namespace relief::volume_truth {

/// Fills the image's rays. Along a ray the sum is taken where the ray meets planes of the grid,
/// `step` standard deviations apart, so that all rays share what is summed across a plane. Between
/// two of them emission and extinction are the cubics through the four next to them. Gives up if
/// `progress` is cancelled.
void integrate_kernels(const NodeKernels& kernels, const RegularGrid& grid, const View& view,
                       double step, SampleImage& into, Progress& progress);

}  // namespace relief::volume_truth
