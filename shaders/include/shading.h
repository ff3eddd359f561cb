// How a surface answers to light, for all engines: GLSL and C++ compile the same text. C++ includes
// it as "shaders/include/shading.h"; shaders as "include/shading.h". Light is linear, directions
// are unit vectors of the world.
#pragma once

#ifdef __cplusplus
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shaders/include/shared.h"
#define RELIEF_FUNCTION inline
#define RELIEF_POINT_LIGHTS 1
namespace relief::shared {
using glm::dot;
using glm::max;
using glm::min;
using glm::normalize;
using glm::pow;
using glm::reflect;
using glm::sqrt;
using glm::vec3;
#else
#include "include/shared.h"
#define RELIEF_FUNCTION
#define RELIEF_POINT_LIGHTS (RELIEF_FEATURES & RELIEF_FEATURE_POINT_LIGHTS) != 0u
#endif

/// The normal of a surface as seen along `ray`, from the eye. A back side shows the reversed
/// normal. At a silhouette, interpolated normals lean a little away from the eye although the front
/// is seen; reversing those would put dark specks on a bright rim, so they are bent to grazing.
RELIEF_FUNCTION vec3 facing_normal(vec3 normal, vec3 ray) {
  float away = dot(normal, ray);
  if (away > 0.6f) return -normal;
  return away > 0.0f ? normalize(normal - away * ray) : normal;
}

/// Phong: the frame's first `lights` lights, a white highlight. `place`: from the eye, world; only
/// point lights ask for it.
RELIEF_FUNCTION vec3 lit(Frame frame, int lights, vec3 albedo, vec3 normal, vec3 ray, vec3 place) {
  const float shininess = 40.0f;
  const float highlight = 0.25f;
  vec3 reflected = reflect(ray, normal);
  vec3 diffuse = vec3(frame.light_ambient);
  vec3 specular = vec3(0.0f);
  for (int i = 0; i < lights; ++i) {
    vec3 direction = vec3(frame.light_place[i]);
    vec3 colour = vec3(frame.light_colour[i]);
#if RELIEF_POINT_LIGHTS
    if (frame.light_place[i].w != 0.0f) {
      vec3 toward = direction - place;
      float squared = max(dot(toward, toward), 1e-20f);
      direction = toward / sqrt(squared);
      colour = min(colour / squared, vec3(kBrightestLight));
    }
#endif
    diffuse += colour * max(dot(normal, direction), 0.0f);
    specular += colour * pow(max(dot(reflected, direction), 1e-6f), shininess);
  }
  return albedo * diffuse + highlight * specular;
}

#ifdef __cplusplus
}  // namespace relief::shared
#endif
