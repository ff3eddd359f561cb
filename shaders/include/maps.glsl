// The attribute maps of patches, for the stage that reads them.
#include "include/patches.glsl"

#define RELIEF_NEEDS_NORMAL                                                             \
  ((RELIEF_FEATURES & (RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS | \
                       RELIEF_FEATURE_OUT_NORMAL)) != 0u)

#if RELIEF_NEEDS_NORMAL
layout(binding = RELIEF_TEXTURE_NORMALS) uniform sampler2DArray normal_maps;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(binding = RELIEF_TEXTURE_COLOURS) uniform sampler2DArray colour_maps;
#endif

// From half its stereographic coordinates, which bilinear lookups interpolate smoothly; octahedral
// ones have creases along the axes, where a mirror would show them.
vec3 unit_from_stereographic(vec2 half_place) {
  vec2 p = 2.0 * half_place;
  return vec3(2.0 * p, 1.0 - dot(p, p)) / (1.0 + dot(p, p));
}

vec3 to_world(PatchInfo info, vec3 v) {
  return info.axis_u.xyz * v.x + info.axis_v.xyz * v.y + info.axis_n.xyz * v.z;
}
