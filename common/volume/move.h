// Puts volumes and Gaussians in their positions.
#pragma once

#include "common/error.h"
#include "common/instance.h"
#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"

namespace relief {

void move_volume(ScalarVolume& volume, const Transform& transform);

/// Turns colours that depend on the direction, too. `transform.rotation` may also be a mirror here
/// (orthonormal, left-handed). Fails, with a clause, if a centre or a scale leaves the range of
/// single precision; the Gaussians are then moved in part.
Status move_gaussians(GaussianCloud& gaussians, const Transform& transform);

}  // namespace relief
