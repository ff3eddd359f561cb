// Vertex stage: what a splat contributes, from the maps at its sample.
#include "include/maps.glsl"

#if RELIEF_NEEDS_NORMAL
layout(location = 3) flat out vec3 splat_normal;  // world, unit
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(location = 4) flat out vec3 splat_colour;  // linear
#endif

void write_attributes(PatchInfo info, vec2 node) {
#if RELIEF_NEEDS_NORMAL
  ivec3 normal_texel = ivec3(info.normals.xy + ivec2(node) * info.normals.w, info.normals.z);
  splat_normal =
      to_world(info, unit_from_stereographic(texelFetch(normal_maps, normal_texel, 0).xy));
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  ivec3 colour_texel = ivec3(info.colours.xy + ivec2(node) * info.colours.w, info.colours.z);
  splat_colour =
      info.colours.w == 0 ? vec3(kNeutralGrey) : texelFetch(colour_maps, colour_texel, 0).rgb;
#endif
}
