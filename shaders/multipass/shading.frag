// Pass 3: normalises the sums and shades, once a pixel. Pass 1 covers no pixel without weight
// (discs.glsl: blending_radius).
#include "include/shade_sums.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
layout(binding = RELIEF_TEXTURE_PATCH_IDS) uniform usampler2D patch_ids;
#endif

void main() {
  count_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int material = 0;
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
  material = fetch_patch(texelFetch(patch_ids, pixel, 0).x - 1u).heights.w;
#endif
  shade_sums(pixel, material);
}
