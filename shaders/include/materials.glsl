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

// What the scene's material makes of a surface seen along `ray` at `depth` along the view axis; an
// unlit one has no normal.
vec3 shade_material(vec3 albedo, vec3 normal, vec3 ray, float depth) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
#if (RELIEF_FEATURES & RELIEF_FEATURE_POINT_LIGHTS) != 0u
  vec3 place = depth * (frame.ray_origin.xyz + gl_FragCoord.x * frame.ray_x.xyz +
                        gl_FragCoord.y * frame.ray_y.xyz);
#else
  vec3 place = vec3(0.0);
#endif
  return lit(frame, int(RELIEF_FEATURES >> RELIEF_LIGHTS_SHIFT), albedo,
             facing_normal(normal, ray), ray, place);
#elif (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
  return mirror(facing_normal(normal, ray), ray);
#else
  return albedo;
#endif
}
