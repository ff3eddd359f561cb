// The distance of patches to the points that they were made from, as a scalar.
#pragma once

#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"

namespace relief {

/// Adds the scalar kDistanceScalar: at every sample the distance to the nearest of `positions`,
/// world units. It is about half a spacing where the surface follows the points, and more where it
/// spans a gap. Fails if the model has kMaxScalars already, or if the user interrupts.
Status add_distances(const std::vector<glm::dvec3>& positions, PatchModel& model,
                     Progress& progress);

}  // namespace relief
