// Pass 1: cuts the polygon down to the disc. (Depth values are the rasteriser's.)
#define RELIEF_LATE_TESTS  // what is cut off must not write its depth
#include "include/counting.glsl"
#include "include/patches.glsl"
#include "include/clipping.glsl"
#include "include/clip_kind.glsl"
#include "include/side_in_front.glsl"

layout(location = 0) in vec2 disc;
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH | RELIEF_FEATURE_MIXED)) != 0u
layout(location = 1) flat in uvec4 identity;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
layout(location = RELIEF_OUT_UV) out vec2 out_uv;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
layout(location = RELIEF_OUT_PATCH) out uint out_patch;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
layout(location = RELIEF_OUT_MATERIAL) out uint out_material;
#endif

void main() {
  count_fragment();
  if (dot(disc, disc) > 1.0) discard;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  if (is_clipped(disc, 0.0)) discard;
#endif
  write_clip_kind();
  write_side_in_front();
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
  out_uv = uintBitsToFloat(identity.xy);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
  out_patch = identity.z;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
  out_material = identity.w;
#endif
}
