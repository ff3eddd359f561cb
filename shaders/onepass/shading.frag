// Shades what cells and their border splats have found, once a pixel.
#include "include/counting.glsl"
#include "include/surface.glsl"

layout(binding = RELIEF_TEXTURE_FOUND) uniform sampler2D found_places;

void main() {
  count_fragment();
  vec4 found = texelFetch(found_places, ivec2(gl_FragCoord.xy), 0);
  vec3 ray = frame.ray_origin.xyz + gl_FragCoord.x * frame.ray_x.xyz + gl_FragCoord.y * frame.ray_y.xyz;
  shade_place(fetch_patch(uint(found.z)), found.xy, normalize(ray), found.w);
}
