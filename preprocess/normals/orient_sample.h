// Sides of a whole scan, found from a sample of its points.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/progress.h"
#include "preprocess/normals/known_sides.h"
#include "preprocess/normals/sampled_sides.h"

namespace relief {

/// Returns the normals of a sample without its stray points, oriented as those of a scan of its own
/// (orient_normals()). A part of a scan sees no surroundings: a body on a small piece of its ground
/// looks like a closed body whose bottom is the ground. `points`: at least kMinSurfacePoints,
/// finite, in the frame of `choice`. Of no use if the user interrupts.
[[nodiscard]] SampledSides orient_sample(std::vector<glm::dvec3> points, const SideChoice& choice,
                                         const Progress& progress);

}  // namespace relief
