// A light by its direction about the model.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/light.h"
#include "common/stance.h"

namespace relief {

/// A directional light that stays where it is while the camera moves.
struct KeyLight {
  double azimuth_degrees = -35.0;   ///< as an orbit's: 0 is in front, 90 to the right
  double elevation_degrees = 45.0;  ///< above the horizon
  float intensity = 1.0F;           ///< the radiance of a white surface that faces it
};

/// Intensities that a window offers; kMaxLight is the most that a scene may have.
inline constexpr float kMostIntensity = 4.0F;

/// Returns the white light for a model that stands so.
[[nodiscard]] Light light_of(const KeyLight& key, const Stance& stance);

/// Returns what light_of() made.
[[nodiscard]] KeyLight key_light_of(const Light& light, const Stance& stance);

}  // namespace relief
