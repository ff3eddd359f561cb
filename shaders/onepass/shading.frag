// Shades what cells and their border splats have found, once a pixel.
#define RELIEF_SHADES_PICTURE
#include "include/counting.glsl"
#include "include/surface.glsl"
#include "include/visibility.glsl"

layout(binding = RELIEF_TEXTURE_FOUND) uniform usampler2D found_places;
layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D visible_depth;
#if RELIEF_NEEDS_DEPTH
layout(binding = RELIEF_TEXTURE_FOUND_DEPTH) uniform sampler2D found_depths;
#endif

void main() {
  count_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 found = texelFetch(found_places, pixel, 0).xy;
#if (RELIEF_FEATURES & (RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS)) != 0u
  // Reversed depth: 0 where nothing has been found. A surface seen at 84 degrees changes by a
  // hundredth from one pixel to the next where a pixel is a thousandth of the distance.
  float visible = texelFetch(visible_depth, pixel, 0).x;
  neighbours_alike = lessThan(abs(vec2(dFdxFine(visible), dFdyFine(visible))), vec2(0.01 * visible));
#endif
  vec3 ray = normalize(frame.ray_origin.xyz + gl_FragCoord.x * frame.ray_x.xyz +
                       gl_FragCoord.y * frame.ray_y.xyz);
  float depth = 0.0;
#if RELIEF_NEEDS_DEPTH
  depth = texelFetch(found_depths, pixel, 0).x;
#endif
  vec2 place = unpack_place(found);
  vec4 footprint = vec4(0.0);
#if RELIEF_NEEDS_FOOTPRINT
  // Only layers have this: they are shaded later whatever is on them.
  float patch_number = float(unpack_patch(found));
  if (dFdxFine(patch_number) == 0.0) footprint.xy = dFdxFine(place);
  if (dFdyFine(patch_number) == 0.0) footprint.zw = dFdyFine(place);
#endif
  shade_place(fetch_patch(unpack_patch(found)), place, ray, depth, footprint);
}
