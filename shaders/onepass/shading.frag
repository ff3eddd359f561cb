// Shades what cells and their border splats have found, once a pixel.
#include "include/counting.glsl"
#include "include/surface.glsl"
#include "include/visibility.glsl"

layout(binding = RELIEF_TEXTURE_FOUND) uniform usampler2D found_places;
#if RELIEF_NEEDS_DEPTH
layout(binding = RELIEF_TEXTURE_FOUND_DEPTH) uniform sampler2D found_depths;
#endif

void main() {
  count_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 found = texelFetch(found_places, pixel, 0).xy;
  vec3 ray = normalize(frame.ray_origin.xyz + gl_FragCoord.x * frame.ray_x.xyz +
                       gl_FragCoord.y * frame.ray_y.xyz);
  float depth = 0.0;
#if RELIEF_NEEDS_DEPTH
  depth = texelFetch(found_depths, pixel, 0).x;
#endif
  shade_place(fetch_patch(unpack_patch(found)), unpack_place(found), ray, depth);
}
