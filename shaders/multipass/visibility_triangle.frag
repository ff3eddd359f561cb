// Pass 1: cuts the triangle down to the parallelogram.
#define RELIEF_LATE_TESTS  // what is cut off must not write its depth
#include "include/counting.glsl"
#include "include/identity.glsl"
#include "include/clipping.glsl"
#include "include/clip_kind.glsl"
#include "include/side_in_front.glsl"

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 node;
layout(location = 2) flat in uint hit_patch;

void main() {
  count_fragment();
  if (max(position.x, position.y) > 1.0) discard;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  if (is_clipped(node - clip_centre.xy, 0.0)) discard;
#endif
  write_identity(fetch_patch(hit_patch), node);
  write_clip_kind();
  write_side_in_front();
}
