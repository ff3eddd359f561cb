// Pass 3: normalises the sums and shades, once a pixel. Every pixel that pass 1 covers has weight:
// the disc that covers it is in front of itself.
#include "include/shade_sums.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
layout(binding = RELIEF_TEXTURE_PATCH_IDS) uniform usampler2D materials_in_front;
#endif

void main() {
  count_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int material = 0;
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
  material = int(texelFetch(materials_in_front, pixel, 0).x);
#endif
  shade_sums(pixel, material);
}
