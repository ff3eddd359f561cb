// What a surface looks like, all with linear light. What is computed is in shading.h.
#include "include/patches.glsl"
#include "include/shading.h"
// The window position that is shaded. Stages other than the fragment's say it.
#ifndef RELIEF_WINDOW
#define RELIEF_WINDOW gl_FragCoord.xy
#endif
#if (RELIEF_FEATURES & RELIEF_REFLECTING_FEATURES) != 0u
#include "include/environment.glsl"
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_SPLIT) != 0u
#include "include/split_view.h"
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_TWO_INTERFACES) != 0u
#include "include/two_interfaces.glsl"
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
layout(std140, binding = RELIEF_BIND_MATERIALS) uniform MaterialBlock {
  MaterialInfo materials[kMaxMaterials];
};
#endif

#if (RELIEF_FEATURES & (RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_ENVIRONMENT_LIGHT)) != 0u
// `layer`: of a rough environment; below 0 and without any: the one that there is.
vec3 shade_mirror(vec3 facing, vec3 ray, float layer) {
  vec3 along = reflect(ray, facing);
  vec3 smooth_light = see(along);
#if (RELIEF_FEATURES & RELIEF_FEATURE_ROUGH) != 0u
  vec3 rough_light = see_roughly(along, max(layer, 0.0));
  return layer < 0.0 ? smooth_light : rough_light;
#else
  return smooth_light;
#endif
}
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
// `layer`: as shade_mirror has it.
vec3 shade_lit(vec3 albedo, vec3 facing, vec3 ray, float depth, float layer) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_POINT_LIGHTS) != 0u
  vec3 position = position_through(RELIEF_WINDOW, depth);
#else
  vec3 position = vec3(0.0);
#endif
  vec3 colour = lit(frame, RELIEF_LIGHTS, albedo, facing, ray, position);
#if (RELIEF_FEATURES & RELIEF_FEATURE_ENVIRONMENT_LIGHT) != 0u
  colour += lit_by_environment(frame, albedo, facing, ray, shade_mirror(facing, ray, layer));
#endif
  return colour;
}
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_GLASS) != 0u
vec3 shade_glass(MaterialInfo material, vec3 normal, vec3 ray, float depth) {
  SplitRay split = split_ray(normal, ray, material.constants.y);
#if (RELIEF_FEATURES & RELIEF_FEATURE_TWO_INTERFACES) != 0u
  // A back side is seen from within: from there light leaves at once.
  if (material.constants.w > 1.0 && dot(normal, ray) <= kBackSide)
    leave_body(position_through(RELIEF_WINDOW, depth), ray, normal, material.constants.y, split);
#endif
  return glass(split, material.absorption.rgb, see(split.reflected),
               see(split.refracted));
}
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_SPLIT) != 0u
// The samples as they are stored, for the split view; set before a fragment is shaded.
vec3 stored_colour = vec3(0.0);

// What split_view() needs to know of a fragment: its ray, or orthographic its position.
vec3 ray_or_position(vec3 ray) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return position_through(gl_FragCoord.xy, 0.0);
#else
  return ray;
#endif
}
#endif

// Whether the back of what was drawn is seen; set before a fragment is shaded. Blended splats do not
// say.
bool seen_from_behind = false;

// What its material makes of a surface seen along `ray` at `depth` along the view axis; `index`: of
// the material, where there are several. An unlit one has no normal.
vec3 shade_material(int index, vec3 albedo, vec3 normal, vec3 ray, float depth) {
  vec3 colour = albedo;
  vec3 facing = facing_normal(normal, ray, seen_from_behind);
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
  MaterialInfo material = materials[index];
  int kind = int(material.constants.x);
  // Neighbours in an image may have other materials, so that lookups must not hang on the kind:
  // which copy of the environment they read follows from all of them.
#if (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
  vec3 lit_colour = shade_lit(albedo, facing, ray, depth, material.constants.z);
  if (kind == kLit) colour = lit_colour;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
  vec3 reflection = shade_mirror(facing, ray, material.constants.z);
  if (kind == kMirror) colour = reflection;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_SPLIT) != 0u
  if (kind == kSplit) {
    vec3 lit_light = shade_lit(albedo, facing, ray, depth, -1.0);
    colour = split_view(frame, ray_or_position(ray), lit_light, reflection, stored_colour);
  }
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_GLASS) != 0u
  vec3 transmission = shade_glass(material, normal, ray, depth);
  if (kind == kGlass) colour = transmission;
#endif
#elif (RELIEF_FEATURES & RELIEF_FEATURE_SPLIT) != 0u
  colour = split_view(frame, ray_or_position(ray), shade_lit(albedo, facing, ray, depth, -1.0),
                      shade_mirror(facing, ray, -1.0), stored_colour);
#elif (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
  colour = shade_lit(albedo, facing, ray, depth, -1.0);
#elif (RELIEF_FEATURES & RELIEF_FEATURE_MIRROR) != 0u
  colour = shade_mirror(facing, ray, -1.0);
#elif (RELIEF_FEATURES & RELIEF_FEATURE_GLASS) != 0u
  colour = shade_glass(frame.material, normal, ray, depth);
#endif
  return colour;
}

#if (RELIEF_FEATURES & RELIEF_FEATURE_LAYERED) != 0u
// How much of what is behind it a surface of that material covers.
float opacity_of(int index) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
  return materials[index].absorption.w;
#else
  return frame.material.absorption.w;
#endif
}
#endif
