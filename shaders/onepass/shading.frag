// Shades what cells and their border splats have found, once a pixel.
#define RELIEF_SHADES_PICTURE
#include "include/counting.glsl"
#include "include/visibility.glsl"
#include "include/surface.glsl"

layout(binding = RELIEF_TEXTURE_VISIBILITY) uniform usampler2D visible_positions;
layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D visible_depth;
#if RELIEF_NEEDS_DEPTH
layout(binding = RELIEF_TEXTURE_VISIBILITY_DEPTH) uniform sampler2D visibility_depths;
#endif

void main() {
  count_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 found = texelFetch(visible_positions, pixel, 0).xy;
#if (RELIEF_FEATURES & RELIEF_REFLECTING_FEATURES) != 0u
  // Reversed depth: 0 where nothing has been found.
  float visible = texelFetch(visible_depth, pixel, 0).x;
  neighbours_alike = lessThan(abs(vec2(dFdxFine(visible), dFdyFine(visible))), vec2(largest_step(visible)));
#endif
  vec3 ray = normalize(ray_through(gl_FragCoord.xy));
  float depth = 0.0;
#if RELIEF_NEEDS_DEPTH
  depth = texelFetch(visibility_depths, pixel, 0).x;
#endif
  vec2 position = unpack_position(found);
  seen_from_behind = unpack_from_behind(found);
  vec4 footprint = vec4(0.0);
#if RELIEF_NEEDS_FOOTPRINT
  // Only layers have this: they are shaded later whatever is on them.
  float patch_number = float(unpack_patch(found));
  if (dFdxFine(patch_number) == 0.0) footprint.xy = dFdxFine(position);
  if (dFdyFine(patch_number) == 0.0) footprint.zw = dFdyFine(position);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_TWO_INTERFACES) != 0u
  body_diameter = texelFetch(bodies, int(unpack_patch(found))).x;
#endif
  shade_position(fetch_patch(unpack_patch(found)), position, ray, depth, footprint);
}
