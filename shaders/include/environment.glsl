// The surroundings as a cube map of linear light. The frame's uniforms, from whichever block they are,
// are `frame`.
#include "include/shading.h"

layout(binding = RELIEF_TEXTURE_ENVIRONMENT) uniform samplerCube environment;

// Where the environment is looked up for a pixel: `count` directions, `step` apart, at a mip level.
struct EnvironmentLookups {
  vec3 step;
  float count;
  float level;
};

#ifdef RELIEF_MEAN_NORMALS
// The level whose texels are as wide as normals are spread (proxy.vert). Reflections are spread four
// times as far from end to end, but refractions less, and at that level glass was five times too
// bright; with none mirrors were up to three times (docs/decisions/0098).
EnvironmentLookups environment_lookups(vec3 along, float size) {
  return EnvironmentLookups(vec3(0.0), 1.0, log2(max(normal_spread * size / 1.5708, 1.0)));
}
#else
#define RELIEF_ENVIRONMENT_ASKS_NEIGHBOURS
#ifdef RELIEF_SHADES_PICTURE
// Whether the neighbours beside and above (or below) show the same surface: what a lookup there
// differs by is then how much of the environment a pixel sees. Across a silhouette it is not.
bvec2 neighbours_alike = bvec2(true);

vec3 difference(vec3 along, bool upward) {
  vec3 beside = dFdxFine(along);
  vec3 above = dFdyFine(along);
  bvec2 alike = upward ? neighbours_alike.yx : neighbours_alike;
  return alike.x ? (upward ? above : beside) : alike.y ? (upward ? beside : above) : vec3(0.0);
}
#else
vec3 difference(vec3 along, bool upward) {
  return upward ? dFdy(along) : dFdx(along);
}
#endif

const float kMostEnvironmentLookups = 8.0;

// What moves on the cube's face, in halves of its edge, where `along` changes by `change`; `axis` is
// across the face.
vec3 motion_on_face(vec3 along, vec3 change, vec3 axis) {
  float ahead = dot(axis, along);
  return (ahead * change - dot(axis, change) * along) / (ahead * ahead);
}

// The mean over what a pixel sees, an ellipse: lookups along its longer axis, at the mip level of the
// shorter (McCormack et al. 1999, "Feline"). A mirror that bends stretches it far: at the level of the
// longer axis mirrors were 2 to 8 dB further from the truth. By the shader and not by the sampler,
// whose rule drivers approximate, each in its own way (docs/decisions/0134). `size`: texels of an edge.
EnvironmentLookups environment_lookups(vec3 along, float size) {
  vec3 ahead = abs(along);
  vec3 axis = ahead.x >= max(ahead.y, ahead.z) ? vec3(1.0, 0.0, 0.0)
              : ahead.y >= ahead.z             ? vec3(0.0, 1.0, 0.0)
                                               : vec3(0.0, 0.0, 1.0);
  vec3 across = difference(along, false);
  vec3 upward = difference(along, true);
  vec3 across_on_face = motion_on_face(along, across, axis);
  vec3 upward_on_face = motion_on_face(along, upward, axis);
  // The squares of the axes are eigenvalues of the products of the two.
  float xx = dot(across_on_face, across_on_face);
  float xy = dot(across_on_face, upward_on_face);
  float yy = dot(upward_on_face, upward_on_face);
  float mean = 0.5 * (xx + yy);
  float spread = length(vec2(0.5 * (xx - yy), xy));
  float longer = sqrt(mean + spread);
  float shorter = sqrt(max(mean - spread, 0.0));
  // In this form an ellipse that is NaN or endless becomes a point.
  if (!(longer > 0.0 && longer < 1e6)) return EnvironmentLookups(vec3(0.0), 1.0, 0.0);
  float count = clamp(ceil(longer / max(shorter, 1e-6 * longer)), 1.0, kMostEnvironmentLookups);
  vec2 direction = xx >= yy ? vec2(0.5 * (xx - yy) + spread, xy) : vec2(xy, 0.5 * (yy - xx) + spread);
  direction *= inversesqrt(max(dot(direction, direction), 1e-30));
  float texels = 0.5 * size * max(shorter, longer / count);
  return EnvironmentLookups((direction.x * across + direction.y * upward) / count, count,
                            log2(max(texels, 1.0)));
}
#endif

// The body of a function of a direction `along` of the world: what a pixel sees of `environments`
// there. `position` says where in them it is that `direction` looks.
#define RELIEF_SEE(environments, position)                                                      \
  along = to_environment(frame, along);                                                         \
  EnvironmentLookups lookups =                                                                  \
      environment_lookups(along, float(textureSize(environments, 0).x));                        \
  vec3 first = along - 0.5 * (lookups.count - 1.0) * lookups.step;                              \
  vec3 sum = vec3(0.0);                                                                         \
  for (float k = 0.0; k < lookups.count; k += 1.0) {                                            \
    vec3 direction = first + k * lookups.step;                                                  \
    sum += textureLod(environments, position, lookups.level).rgb;                               \
  }                                                                                             \
  return sum / lookups.count

vec3 see(vec3 along) {
  RELIEF_SEE(environment, direction);
}

#if (RELIEF_FEATURES & RELIEF_FEATURE_ROUGH) != 0u
layout(binding = RELIEF_TEXTURE_ROUGH_ENVIRONMENTS) uniform samplerCubeArray rough_environments;

vec3 see_roughly(vec3 along, float layer) {
  RELIEF_SEE(rough_environments, vec4(direction, layer));
}
#endif
