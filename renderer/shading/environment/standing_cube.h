// How the surroundings stand about a model.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "renderer/settings.h"
#include "renderer/shading/environment/cube_map.h"
#include "shaders/include/shared.h"

namespace relief {

/// The rotation from the world to the frame of environments, whose +Y is up and whose middle is
/// -Z. Up is that of the stance, the middle is behind the model. The environment is turned about
/// the up direction as an orbit's azimuth is: at 90 degrees, what was in front of the model is to
/// its right. Of the usual stance at 0 degrees exactly the identity.
[[nodiscard]] glm::dmat3 environment_from_world(const RenderSettings& settings);

/// The same for shaders.
void set_environment(shared::Frame& frame, const glm::dmat3& from_world);

/// An environment as it stands in the world. Nothing is owned.
struct StandingCube {
  const CubeMap* cube = nullptr;
  glm::dmat3 from_world{1.0};
};

/// The light from a direction of the world (any length but 0).
[[nodiscard]] inline glm::vec3 look_up(const StandingCube& environment, glm::dvec3 direction) {
  return look_up(*environment.cube, environment.from_world * direction);
}

}  // namespace relief
