#include "viewer/choices/key_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "common/scene/views/standing_direction.h"

namespace relief {

Light light_of(const KeyLight& key, const Stance& stance) {
  Light light;
  light.position = standing_direction(stance, key.azimuth_degrees, key.elevation_degrees);
  light.colour = glm::vec3(key.intensity);
  return light;
}

KeyLight key_light_of(const Light& light, const Stance& stance) {
  const glm::dvec3 right = glm::cross(stance.up, stance.front);
  KeyLight key;
  key.azimuth_degrees = glm::degrees(
      std::atan2(glm::dot(light.position, right), glm::dot(light.position, stance.front)));
  key.elevation_degrees =
      glm::degrees(std::asin(std::clamp(glm::dot(light.position, stance.up), -1.0, 1.0)));
  key.intensity = light.colour.g;
  return key;
}

}  // namespace relief
