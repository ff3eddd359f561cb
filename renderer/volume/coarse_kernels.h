// Coarser kernels of a regular grid, for views in which its nodes are less than a pixel apart.
#pragma once

#include "common/volume/scalar_volume.h"
#include "renderer/view/view.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"

namespace relief {

/// How often a grid's kernels can be halved such that their nodes are seen at most `pixels` apart,
/// where the grid is nearest to the eye. 0 if part of it is beside or behind the eye.
[[nodiscard]] int coarse_level(const ScalarVolume& volume, const RegularGrid& grid,
                               const View& view, double pixels);

/// Halves a grid's kernels `level` times: each becomes the sum of 2 x 2 x 2 of them, at their mean
/// place, with their mean colour and normal, all weighted by the extinction, and a variance that
/// has their second moment. `cloud`: of that grid, with one variance for all. Where a layer's
/// opacity is its optical depth (Attenuation::Linear), two layers become one that lets as much
/// light through.
[[nodiscard]] KernelCloud coarse_kernels(KernelCloud cloud, const RegularGrid& grid, int level,
                                         Attenuation attenuation);

}  // namespace relief
