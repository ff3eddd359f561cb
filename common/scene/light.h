// The lights of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

enum class LightKind : std::uint8_t { Directional, Point };

/// A light that shines on all surfaces, through whatever is between: there are no shadows.
struct Light {
  LightKind kind = LightKind::Directional;
  /// World frame. Directional: a unit vector toward the light. Point: where it is.
  glm::dvec3 place{0.0, 0.0, 1.0};
  /// Linear, what a white surface facing it sends back; of a point light at a distance of 1 world
  /// unit, and falling with the distance's square.
  glm::vec3 colour{1.0F};
};

/// The most lights of an image.
inline constexpr std::size_t kMaxLights = 16;

/// The brightest directional light, and the most that any light is at a surface: 16 of them, with
/// their highlights, stay below the largest half float.
inline constexpr double kMaxLight = 1000.0;
/// The brightest point light: it is kMaxLight at a distance of 30,000 world units.
inline constexpr double kMaxPointLight = 1e12;

/// The lights of an image.
struct Lights {
  std::vector<Light> list;   ///< at most kMaxLights; empty: three that are fixed to the camera
  glm::vec3 ambient{0.06F};  ///< linear, from everywhere
};

}  // namespace relief
