// The distance of a point to a patch.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/patch.h"

namespace relief {

/// Returns the distance (world units) of a world point to a patch's bilinear surface along the
/// patch's normal. In a cell of four samples the surface is bilinear, in a cell of three a plane;
/// elsewhere the distance is that to the nearest sample within two cells. Nothing if there is no
/// sample that near.
[[nodiscard]] std::optional<double> distance_to_patch(const Patch& patch, glm::dvec3 point);

}  // namespace relief
