// What cameras see of a volume.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"

namespace relief {

/// Points (world) whose bounds are those of the volume: the corners of a grid, or all nodes.
[[nodiscard]] std::vector<glm::dvec3> extent_of(const ScalarVolume& volume);

/// Likewise of Gaussians: the corners of the box that holds all but the outermost hundredth of
/// their centres along each axis, on either side. Trained scenes have strays far away.
[[nodiscard]] std::vector<glm::dvec3> extent_of(const GaussianCloud& gaussians);

}  // namespace relief
