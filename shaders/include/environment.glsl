// The surroundings as a cube map of linear light, world directions.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_ENVIRONMENT) uniform samplerCube environment;

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
#define RELIEF_SEE(environments, position, along) \
  textureGrad(environments, position, difference(along, false), difference(along, true)).rgb
#elif defined(RELIEF_MEAN_NORMALS)
// The level whose texels are as wide as normals are spread (proxy.vert). Reflections are spread four
// times as far from end to end, but refractions less, and at that level glass was five times too
// bright; with none mirrors were up to three times (docs/decisions/0098).
float level_of_mean(float size) {
  return log2(max(normal_spread * size / 1.5708, 1.0));
}
#define RELIEF_SEE(environments, position, along) \
  textureLod(environments, position, level_of_mean(float(textureSize(environments, 0).x))).rgb
#else
#define RELIEF_SEE(environments, position, along) texture(environments, position).rgb
#endif

vec3 see(vec3 along) {
  return RELIEF_SEE(environment, along, along);
}
