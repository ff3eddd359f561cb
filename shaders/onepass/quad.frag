// The quad itself is the splat's plane: rasterising it has intersected the view ray with it.
#include "include/counting.glsl"
#include "include/limits.glsl"
#include "include/patches.glsl"
#if (RELIEF_FEATURES & RELIEF_FEATURE_VISIBILITY) != 0u
#include "include/visibility.glsl"
#if (RELIEF_FEATURES & RELIEF_FEATURE_LAYERED) != 0u
#include "include/layers.glsl"
#endif
#else
#include "include/surface.glsl"
#endif
#include "include/discarding.glsl"
#if (RELIEF_FEATURES & RELIEF_FEATURE_MASKED) != 0u
#include "include/mask.glsl"
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_CORRECTED) != 0u
#include "include/interpolation.glsl"
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_VISIBILITY) != 0u
layout(location = RELIEF_OUT_VISIBILITY) out uvec2 out_visibility;
#if RELIEF_NEEDS_DEPTH
layout(location = RELIEF_OUT_VISIBILITY_DEPTH) out float out_visibility_depth;  // along the view axis
#endif
#endif

layout(location = 0) flat in uint hit_patch;
layout(location = 1) in vec3 hit;
#if (RELIEF_FEATURES & RELIEF_FEATURE_LARGE_SPRITES) != 0u
layout(location = 2) flat in vec4 disc;  // centre in the grid frame, radius
layout(location = 3) flat in vec4 limits;
#endif

void main() {
  count_fragment();
#if (RELIEF_FEATURES & RELIEF_FEATURE_VISIBILITY) == 0u
  vec4 footprint = RELIEF_FOOTPRINT(hit.xy);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_LARGE_SPRITES) != 0u
  RELIEF_DISCARD_IF(distance(hit, disc.xyz) > disc.w || !within_limits(hit.xy - disc.xy, limits));
#endif
  PatchInfo info = fetch_patch(hit_patch);
  vec3 position = hit;
  vec4 eye = fetch_eye(hit_patch);
  vec3 ray = ray_toward(hit, eye);
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  float depth = eye.w + info.axis_u.w * dot(eye.xyz, hit);
#else
  float depth = 1.0 / gl_FragCoord.w;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_CORRECTED) != 0u
  float along;
  RELIEF_DISCARD_IF(!correct(position, ray, info, along));
  depth = depth_beyond(depth, along, info.axis_u.w);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_MASKED) != 0u
  RELIEF_DISCARD_IF(!within_mask(info, position.xy));
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_LAYERED) != 0u
  RELIEF_DISCARD_IF(!in_next_layers(info.axis_u.w));
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_VISIBILITY) != 0u
  out_visibility = pack_position(position.xy, hit_patch, !gl_FrontFacing);
#if RELIEF_NEEDS_DEPTH
  out_visibility_depth = depth;
#endif
#else
  seen_from_behind = !gl_FrontFacing;
  shade(info, position, ray, depth, footprint);
#endif
  RELIEF_DISCARD_LOST;
}
