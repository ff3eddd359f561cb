// What a surface looks like: one function per material, all with linear light. Phong is in shading.h.
#include "include/patches.glsl"
#include "include/shading.h"
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
#include "include/environment.glsl"
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
vec3 mirror(vec3 normal, vec3 ray) {
  return texture(environment, reflect(ray, normal)).rgb;
}
#endif
