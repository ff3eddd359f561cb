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

// What the scene's material makes of a surface seen along `ray`; an unlit one has no normal.
vec3 shade_material(vec3 albedo, vec3 normal, vec3 ray) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
  return lit(frame, albedo, facing_normal(normal, ray), ray);
#elif (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
  return mirror(facing_normal(normal, ray), ray);
#else
  return albedo;
#endif
}
