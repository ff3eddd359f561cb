// Points of a patch that are laid out by hand.
#pragma once

#include <cstdint>

#include "preprocess/resample/surroundings/patch_points.h"

namespace relief::test {

/// Adds a point, patch frame.
inline void lay_point(PatchPoints& points, glm::dvec3 position, glm::vec3 normal, float spacing) {
  points.ids.push_back(static_cast<std::uint32_t>(points.ids.size()));
  points.positions.push_back(position);
  points.normals.push_back(normal);
  points.spacing.push_back(spacing);
}

}  // namespace relief::test
