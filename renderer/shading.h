// Shading on the CPU, by the same text as the shaders (shaders/include/shading.h).
#pragma once

#include <glm/vec3.hpp>

#include "renderer/cube_map.h"
#include "renderer/render.h"
#include "shaders/include/shared.h"

namespace relief {

/// What a material makes of a surface seen along `ray` (unit, world, from the eye). `albedo` is
/// linear, `normal` a unit vector of the world. `frame` has the lights; `cube` is needed by the
/// mirror alone.
[[nodiscard]] glm::vec3 shade(Material material, glm::vec3 albedo, glm::vec3 normal, glm::vec3 ray,
                              const shared::Frame& frame, const CubeMap* cube);

}  // namespace relief
