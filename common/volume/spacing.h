// How far apart the nodes of a volume are.
#pragma once

#include "common/volume/scalar_volume.h"

namespace relief {

/// The mean distance of neighbours, world units; 1 for a volume without extent.
[[nodiscard]] double mean_spacing(const ScalarVolume& volume);

}  // namespace relief
