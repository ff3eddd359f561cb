#include "renderer/shading/environment/standing_cube.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace relief {

glm::dmat3 environment_from_world(const RenderSettings& settings) {
  const Stance& stance = settings.environment_stance;
  const double angle = glm::radians(settings.environment_rotation_degrees);
  const glm::dvec3 right = glm::cross(stance.up, stance.front);
  const glm::dvec3 front = std::cos(angle) * stance.front + std::sin(angle) * right;
  return glm::transpose(glm::dmat3(glm::cross(stance.up, front), stance.up, front));
}

void set_environment(shared::Frame& frame, const glm::dmat3& from_world) {
  for (glm::length_t axis = 0; axis < 3; ++axis)
    frame.environment_from_world[axis] = glm::vec4(glm::dvec4(from_world[axis], 0.0));
}

}  // namespace relief
