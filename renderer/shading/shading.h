// Shading on the CPU, by the same text as the shaders (shaders/include/shading.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/settings.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/shading/environment/standing_cube.h"
#include "renderer/view/view.h"
#include "shaders/include/shared.h"

namespace relief {

/// A material and the environment that it reflects, without a cube if it reflects none.
struct LitMaterial {
  MaterialSettings settings;
  StandingCube environment = {};
};

/// What surfaces are shaded with. Nothing is owned.
struct Lighting {
  shared::Frame frame;                 ///< has the lights
  int lights = 0;                      ///< how many of them
  std::vector<LitMaterial> materials;  ///< by index; not empty
};

/// The lighting of an image; environments are made as they are needed. Fails if one can't be read.
Result<Lighting> make_lighting(const RenderSettings& settings, const View& view,
                               EnvironmentCache& environments);

/// The material of that index; where there is but one, that, whatever the index.
[[nodiscard]] const LitMaterial& lit_material(const Lighting& lighting, std::size_t material);
[[nodiscard]] const MaterialSettings& material_of(const Lighting& lighting, std::size_t material);

/// A surface as it is seen. World frame.
struct SeenSurface {
  glm::vec3 albedo{0.0F};    ///< linear
  glm::vec3 normal{0.0F};    ///< unit
  glm::vec3 ray{0.0F};       ///< unit, from the eye
  glm::vec3 position{0.0F};  ///< from the eye; only point lights ask for it
  glm::vec2 uv{0.0F};        ///< grid coordinates; only Split asks for them and for the patch
  std::uint32_t patch = 1;   ///< patch id + 1
  bool from_behind = false;  ///< the back of a triangle or of splats is seen
};

/// The light that it sends to the eye if it has that material (as material_of).
[[nodiscard]] glm::vec3 shade(const Lighting& lighting, std::size_t material,
                              const SeenSurface& surface);

}  // namespace relief
