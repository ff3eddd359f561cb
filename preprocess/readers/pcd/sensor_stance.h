// How the points of a PCD file stand.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/stance.h"

namespace relief {

/// The VIEWPOINT of a PCD file: the sensor's position, and its axes: X to the right, Y down, Z
/// ahead. The default is in most files, whatever the frame of their points.
struct SensorPose {
  glm::dvec3 position{0.0};
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< from the sensor's axes to the points'
};

/// Returns the sensor's stance if the points are where it can have seen them: all but 1 % ahead,
/// less than 75 degrees off its line of sight, in its pose or in the default one. Otherwise they
/// are a map, whose Z is up, as is usual in robotics. Points that are not finite do not count.
[[nodiscard]] Stance sensor_stance(const std::vector<glm::dvec3>& positions,
                                   const SensorPose& pose);

}  // namespace relief
