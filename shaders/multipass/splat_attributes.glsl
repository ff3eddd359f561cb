// Vertex stage: what a splat contributes, from the maps at its sample.
#include "include/maps.glsl"

#define RELIEF_NORMAL_PER_SPLAT \
  (RELIEF_NEEDS_NORMAL && (RELIEF_FEATURES & RELIEF_FEATURE_FINE_NORMALS) == 0u)
#define RELIEF_COLOUR_PER_SPLAT                            \
  ((RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u && \
   (RELIEF_FEATURES & RELIEF_FEATURE_FINE_COLOURS) == 0u)

#if RELIEF_NORMAL_PER_SPLAT
layout(location = 3) flat out vec3 splat_normal;  // world, unit
#endif
#if RELIEF_COLOUR_PER_SPLAT
layout(location = 4) flat out vec3 splat_colour;  // linear
#endif
#if RELIEF_NEEDS_FOOTPRINT
layout(location = 5) flat out vec2 splat_position;  // of its centre, grid coordinates
layout(location = 7) flat out uint splat_patch;
#endif
#if RELIEF_NEEDS_FOOTPRINT || (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
layout(location = 6) flat out vec4 splat_axes;  // how those change along the axes of its unit disc
#endif

// The texel of a map at a node; nodes of a level beyond the patch have its edge's.
ivec3 texel_at(ivec4 map, PatchInfo info, vec2 node) {
  return ivec3(map.xy + ivec2(clamp_to_patch(info, node) * float(map.w)), map.z);
}

// `axes`: as of splat_axes.
void write_attributes(uint patch_index, PatchInfo info, vec2 node, vec4 axes) {
#if RELIEF_NORMAL_PER_SPLAT
  ivec3 normal_texel = texel_at(info.normals, info, node);
  splat_normal =
      to_world(info, unit_from_stereographic(texelFetch(normal_maps, normal_texel, 0).xy));
#endif
#if RELIEF_NEEDS_FOOTPRINT
  splat_patch = patch_index;
  splat_position = node;
#endif
#if RELIEF_NEEDS_FOOTPRINT || (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  splat_axes = axes;
#endif
#if RELIEF_COLOUR_PER_SPLAT
  ivec3 colour_texel = texel_at(info.colours, info, node);
  splat_colour =
      info.colours.w == 0 ? vec3(kNeutralGrey) : texelFetch(colour_maps, colour_texel, 0).rgb;
#endif
}
