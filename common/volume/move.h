// Puts volumes and Gaussians in their positions.
#pragma once

#include "common/error.h"
#include "common/instance.h"
#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"

namespace relief {

void move_volume(ScalarVolume& volume, const Transform& transform);

/// Fails, with a clause, if Gaussians whose colours depend on the direction are turned: their
/// harmonics are not.
Status move_gaussians(GaussianCloud& gaussians, const Transform& transform);

}  // namespace relief
