// The kernels of a classified volume [Zwicker 2002, sections 4 and 6.4].
#pragma once

#include "common/error.h"
#include "common/progress.h"
#include "common/volume/scalar_volume.h"
#include "common/volume/transfer_function.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"

namespace relief {

/// A kernel for each node that is not transparent: its weight is the extinction times the node's
/// own share of space, its variance the squared step times kernel_sigma^2, so that kernels of equal
/// weight sum up to the extinction everywhere in a grid. Those of scattered points are round, as
/// wide as the spacing about them, and sum up to about that (docs/decisions/0125). Normals are
/// against the gradient; 0 where that vanishes. With `settings.iso`, nodes beside its surface have
/// one more kernel, which is flattened along the gradient and moved onto the surface: equal ones
/// sum up to the surface's optical depth, seen from the front. Returns an incomplete cloud if
/// `progress` is cancelled.
[[nodiscard]] KernelCloud kernels_of_volume(const ScalarVolume& volume,
                                            const TransferFunction& function,
                                            const VolumeSettings& settings,
                                            const Progress& progress);

/// Thickness of the layer of nodes that carry the surface, in spacings: nodes of a plane grid at
/// any angle have one on either side.
inline constexpr double kIsoLayer = 1.0;
/// Variance along the normal of a flattened kernel, in squared spacings [Zwicker 2002, 6.4].
inline constexpr double kFlatVariance = 1e-6;

}  // namespace relief
