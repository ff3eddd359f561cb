// Pass 1: casts the view ray at the splat's parallelogram.
#define RELIEF_LATE_TESTS
#include "include/counting.glsl"
#include "multipass/cast_ray.glsl"
#include "include/identity.glsl"
#include "include/clipping.glsl"
#include "include/clip_kind.glsl"
#include "include/side_in_front.glsl"

layout(location = 3) flat in vec4 grid_position;
layout(location = 4) flat in uint hit_patch;

// The vertex stage gives the nearest point of the disc.
layout(depth_less) out float gl_FragDepth;

void main() {
  count_fragment();
  PlaceInPlane hit = cast_ray();
  // In this form an undefined position is discarded too.
  if (!(hit.nearness > 0.0 && max(abs(hit.position.x), abs(hit.position.y)) <= 1.0)) discard;
  vec2 node = grid_position.xy + hit.position * grid_position.zw;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  if (is_clipped(node - clip_centre.xy, 0.0)) discard;
#endif
  gl_FragDepth = set_back(value_at(hit), depths.y);
  write_identity(fetch_patch(hit_patch), node);
  write_clip_kind();
  write_side_in_front();
}
