// How a surface answers to light, for all engines: GLSL and C++ compile the same text. C++ includes
// it as "shaders/include/shading.h"; shaders as "include/shading.h". Light is linear, directions
// are unit vectors of the world.
#pragma once

#ifdef __cplusplus
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shaders/include/shared.h"
#define RELIEF_FUNCTION inline
#define RELIEF_IN(type) const type&  // copying a frame took as long as lighting with it
#define RELIEF_SHADES_LIT 1
#define RELIEF_POINT_LIGHTS 1
#define RELIEF_ENVIRONMENT_LIGHT 1
#define RELIEF_SHADES_GLASS 1
#define RELIEF_TWO_INTERFACES 1
namespace relief::shared {
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::max;
using glm::min;
using glm::normalize;
using glm::reflect;
using glm::sqrt;
using glm::vec3;
#else
#include "include/shared.h"
#define RELIEF_FUNCTION
#define RELIEF_IN(type) type
#define RELIEF_SHADES_LIT (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
#define RELIEF_POINT_LIGHTS (RELIEF_FEATURES & RELIEF_FEATURE_POINT_LIGHTS) != 0u
#define RELIEF_ENVIRONMENT_LIGHT (RELIEF_FEATURES & RELIEF_FEATURE_ENVIRONMENT_LIGHT) != 0u
#define RELIEF_SHADES_GLASS (RELIEF_FEATURES & RELIEF_FEATURE_GLASS) != 0u
#define RELIEF_TWO_INTERFACES (RELIEF_FEATURES & RELIEF_FEATURE_TWO_INTERFACES) != 0u
#endif

/// The normal of a surface as seen along `ray`, from the eye. A back side shows the reversed
/// normal. At a silhouette, interpolated normals lean a little away from the eye although the front
/// is seen; reversing those would put dark specks on a bright rim, so they are bent to grazing.
/// `from_behind`: whether the back of a triangle or of a patch's splat is seen. Where nothing
/// tells, only a normal that points far away from the eye does.
RELIEF_FUNCTION vec3 facing_normal(vec3 normal, vec3 ray, bool from_behind) {
  float away = dot(normal, ray);
  if (away > (from_behind ? kBackOfTriangle : kBackSide)) return -normal;
  return away > 0.0f ? normalize(normal - away * ray) : normal;
}

#if RELIEF_SHADES_LIT
/// x^40: the highlight's shape. pow() takes ten times as long on CPUs.
RELIEF_FUNCTION float highlight(float x) {
  float x2 = x * x;
  float x4 = x2 * x2;
  float x8 = x4 * x4;
  float x16 = x8 * x8;
  return x16 * x16 * x8;
}

/// Phong: the frame's first `lights` lights, a white highlight (light_ambient.w of each light).
/// `position`: from the eye, world; only point lights ask for it.
RELIEF_FUNCTION vec3 lit(RELIEF_IN(Frame) frame, int lights, vec3 albedo, vec3 normal, vec3 ray,
                         vec3 position) {
  vec3 reflected = reflect(ray, normal);
  vec3 diffuse = vec3(frame.light_ambient);
  vec3 specular = vec3(0.0f);
  for (int i = 0; i < lights; ++i) {
    vec3 direction = vec3(frame.light_position[i]);
    vec3 colour = vec3(frame.light_colour[i]);
#if RELIEF_POINT_LIGHTS
    if (frame.light_position[i].w != 0.0f) {
      vec3 toward = direction - position;
      float squared = max(dot(toward, toward), 1e-20f);
      direction = toward / sqrt(squared);
      colour = min(colour / squared, vec3(kBrightestLight));
    }
#endif
    diffuse += colour * max(dot(normal, direction), 0.0f);
    specular += colour * highlight(max(dot(reflected, direction), 0.0f));
  }
  return albedo * diffuse + frame.light_ambient.w * specular;
}
#endif

/// A direction of the world in the frame of the environment.
RELIEF_FUNCTION vec3 to_environment(RELIEF_IN(Frame) frame, vec3 direction) {
  return direction.x * vec3(frame.environment_from_world[0]) +
         direction.y * vec3(frame.environment_from_world[1]) +
         direction.z * vec3(frame.environment_from_world[2]);
}

#if RELIEF_ENVIRONMENT_LIGHT
/// The light that a white surface scatters under the frame's environment: nine spherical harmonics
/// (Ramamoorthi and Hanrahan 2001, Eq. 13, over pi). Their error is 1 % of the mean on average.
RELIEF_FUNCTION vec3 scattered(RELIEF_IN(Frame) frame, vec3 normal) {
  vec3 n = to_environment(frame, normal);
  vec3 sum = vec3(frame.irradiance[0]) + n.y * vec3(frame.irradiance[1]) +
             n.z * vec3(frame.irradiance[2]) + n.x * vec3(frame.irradiance[3]) +
             (n.x * n.y) * vec3(frame.irradiance[4]) + (n.y * n.z) * vec3(frame.irradiance[5]) +
             (3.0f * n.z * n.z - 1.0f) * vec3(frame.irradiance[6]) +
             (n.x * n.z) * vec3(frame.irradiance[7]) +
             (n.x * n.x - n.y * n.y) * vec3(frame.irradiance[8]);
  return max(sum, vec3(0.0f));
}

/// A dielectric surface in the frame's environment. `reflected`: what a mirror of kLitRoughness
/// shows there; how much of it is seen is Karis's fit to the integral over the microfacets (2014,
/// "Physically Based Shading on Mobile"), for a reflectance of 4 % head on.
RELIEF_FUNCTION vec3 lit_by_environment(RELIEF_IN(Frame) frame, vec3 albedo, vec3 normal, vec3 ray,
                                        vec3 reflected) {
  const float head_on = 0.04f;
  float facing = max(-dot(normal, ray), 0.0f);
  float a = 1.0f - kLitRoughness;
  float b = 0.0425f - 0.0275f * kLitRoughness;
  float c = 1.04f - 0.572f * kLitRoughness;
  float d = 0.022f * kLitRoughness - 0.04f;
  float grazing = min(a * a, exp2(-9.28f * facing)) * a + b;
  float share = head_on * (c - 1.04f * grazing) + 1.04f * grazing + d;
  return (1.0f - share) * albedo * scattered(frame, normal) + share * reflected;
}
#endif

#if RELIEF_SHADES_GLASS
/// What becomes of a ray at a surface of glass. Directions are unit vectors.
struct SplitRay {
  vec3 reflected;
  vec3 refracted;     ///< of no meaning where all is reflected
  float reflectance;  ///< how much of the light is reflected, 0 to 1
  float path;         ///< through the glass, in diameters of the body (MaterialConstants)
};

/// Reflection and refraction at one interface ([Ochotta 2008], section 3.6), unpolarised, by
/// Fresnel's equations. `facing`: the normal on the ray's side; `ratio`: index of refraction there
/// over that behind it. Beyond the critical angle all light is reflected.
RELIEF_FUNCTION SplitRay split_facing(vec3 facing, vec3 ray, float ratio) {
  float before = max(-dot(facing, ray), 0.0f);
  // Snell's law, in a form that is exact for an index of 1; beyond the critical angle 0, for which
  // Fresnel's equations give 1.
  float squared = ratio * ratio;
  float behind = sqrt(max((1.0f - squared) + squared * before * before, 0.0f));
  // Both are 0 at grazing incidence with an index of 1, where nothing is reflected.
  float across = (ratio * before - behind) / max(ratio * before + behind, 1e-20f);
  float along = (before - ratio * behind) / max(before + ratio * behind, 1e-20f);
  SplitRay split;
  split.reflected = reflect(ray, facing);
  split.refracted = ratio * ray + (ratio * before - behind) * facing;
  split.reflectance = 0.5f * (across * across + along * along);
  split.path = behind;
  return split;
}

/// The same where the eye sees a surface. `ior`: of the glass over what surrounds it, at least 1. A
/// back side is left from within.
RELIEF_FUNCTION SplitRay split_ray(vec3 normal, vec3 ray, float ior) {
  bool within = dot(normal, ray) > kBackSide;
  vec3 facing = facing_normal(normal, ray, false);
  SplitRay split = split_facing(facing, ray, within ? ior : 1.0f / ior);
  if (within) split.path = max(-dot(facing, ray), 0.0f);
  return split;
}

#if RELIEF_TWO_INTERFACES
/// The same where a ray within the body meets its surface. `normal`: outward; where an
/// interpolation leans it against the ray that goes straight on.
RELIEF_FUNCTION SplitRay split_within(vec3 normal, vec3 ray, float ior) {
  return split_facing(facing_normal(-normal, ray, false), ray, ior);
}
#endif

/// The light of a surface of glass, from that which comes along both rays. (That radiance grows
/// with the square of the index within glass is left out: the ray leaves it again.)
RELIEF_FUNCTION vec3 glass(SplitRay split, vec3 absorption, vec3 reflected, vec3 refracted) {
  vec3 passed = exp(-split.path * absorption) * refracted;
  return passed + split.reflectance * (reflected - passed);
}
#endif

#ifdef __cplusplus
}  // namespace relief::shared
#endif
