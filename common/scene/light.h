// The lights of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

enum class LightKind : std::uint8_t { Directional, Point };

/// A light that shines on all surfaces, with no shadows.
struct Light {
  LightKind kind = LightKind::Directional;
  /// World frame. Point: its position. Directional: a unit vector toward the light.
  glm::dvec3 position{0.0, 0.0, 1.0};
  /// Linear: the radiance of a white surface that faces the light. A point light's is for a
  /// distance of 1 world unit and falls with the distance's square.
  glm::vec3 colour{1.0F};
};

/// Maximum number of lights of an image.
inline constexpr std::size_t kMaxLights = 16;

/// Maximum of a directional light, and of any light at a surface: 16 of them, with their
/// highlights, stay below the largest half float.
inline constexpr double kMaxLight = 1000.0;
/// Maximum of a point light: kMaxLight at a distance of 30,000 world units.
inline constexpr double kMaxPointLight = 1e12;

/// The lights of an image.
struct Lights {
  std::vector<Light> list;   ///< at most kMaxLights; empty: three lights fixed to the camera
  glm::vec3 ambient{0.06F};  ///< linear, from all directions
  float highlight = 0.25F;   ///< that a lit surface shows of each light, a share of it
  /// The environment gives light, too, and there are no lights fixed to the camera.
  bool from_environment = false;
};

}  // namespace relief
