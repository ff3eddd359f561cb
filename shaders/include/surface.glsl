// Fragment stage: from a position on a patch to the outputs.
#include "include/identity.glsl"
#include "include/maps.glsl"
#include "include/materials.glsl"

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;  // linear; alpha: coverage
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
layout(location = RELIEF_OUT_NORMAL) out vec4 out_normal;  // world, as the map has it
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
layout(location = RELIEF_OUT_DEPTH) out float out_depth;  // along the view axis
#endif

// How grid coordinates change from pixel to pixel, to the right and upward: what a fine map is
// averaged over. To be asked for before any fragment is discarded.
#if RELIEF_NEEDS_FOOTPRINT
#define RELIEF_FOOTPRINT(position) vec4(dFdx(position), dFdy(position))
#else
#define RELIEF_FOOTPRINT(position) vec4(0.0)
#endif

// Shades a position of the patch (grid coordinates), seen along `view` (world, of length 1) at `depth`
// along the view axis.
void shade_position(PatchInfo info, vec2 position, vec3 view, float depth, vec4 footprint) {
  vec2 uv = clamp_to_patch(info, position);
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  // A patch without colours among coloured ones has no texel for that grey: sRGB in 8 bits lacks it.
  vec3 albedo = vec3(kNeutralGrey);
#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_COLOURS) != 0u
  if (info.colours.w != 0) albedo = look_up_colour(info, uv, footprint);
#else
  if (info.colours.w != 0) albedo = look_up(colour_maps, info.colours, uv).rgb;
#endif
#else
  vec3 albedo = vec3(kNeutralGrey);
#endif
#if RELIEF_NEEDS_NORMAL
  vec3 normal = to_world(info, look_up_normal(info, uv, footprint));
#else
  vec3 normal = vec3(0.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_SPLIT) != 0u
  stored_colour = stored_samples(uv - info.extent.x, uint(info.nodes.z));
#endif
  out_colour = vec4(shade_material(info.heights.w, albedo, normal, view, depth), 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_LAYERED) != 0u
  out_colour *= opacity_of(info.heights.w);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
  out_normal = vec4(normal, 0.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
  out_depth = depth;
#endif
  write_identity(info, uv);
}

// Shades the position `hit`, seen along `ray`, both in the grid frame.
void shade(PatchInfo info, vec3 hit, vec3 ray, float depth, vec4 footprint) {
#if RELIEF_NEEDS_NORMAL
  vec3 view = normalize(to_world(info, ray));
#else
  vec3 view = vec3(0.0);
#endif
  shade_position(info, hit.xy, view, depth, footprint);
}
