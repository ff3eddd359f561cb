// Directions about a model that stands.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "common/stance.h"

namespace relief {

/// The unit vector, world frame, of an azimuth, which is 0 in front of the model and 90 degrees to
/// the right of who stands there, and of an elevation above the horizon. With Z up 0 is the south,
/// 90 the east.
[[nodiscard]] inline glm::dvec3 standing_direction(const Stance& stance, double azimuth_degrees,
                                                   double elevation_degrees) {
  const double azimuth = glm::radians(azimuth_degrees);
  const double elevation = glm::radians(elevation_degrees);
  const glm::dvec3 right = glm::cross(stance.up, stance.front);
  return std::cos(elevation) * (std::cos(azimuth) * stance.front + std::sin(azimuth) * right) +
         std::sin(elevation) * stance.up;
}

}  // namespace relief
