// Casts the view ray at the splat's disc.
#include "include/counting.glsl"
#include "include/limits.glsl"
#include "include/surface.glsl"
#include "include/discarding.glsl"
#if (RELIEF_FEATURES & RELIEF_FEATURE_MASKED) != 0u
#include "include/mask.glsl"
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_CORRECTED) != 0u
#include "include/interpolation.glsl"
#endif

layout(location = 0) flat in uint hit_patch;
layout(location = 1) flat in vec4 disc;
layout(location = 2) flat in vec3 plane;
layout(location = 3) flat in vec4 limits;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
layout(location = 4) flat in vec3 seen_at;
#endif

// The vertex stage gives the nearest point of the disc, so that a GPU can still reject early.
layout(depth_less) out float gl_FragDepth;

// A world direction in the patch's grid frame, in cells.
vec3 to_grid(PatchInfo info, vec3 v) {
  return vec3(dot(v, info.axis_u.xyz), dot(v, info.axis_v.xyz), dot(v, info.axis_n.xyz)) /
         info.axis_u.w;
}

void main() {
  count_fragment();
  PatchInfo info = fetch_patch(hit_patch);
  vec4 eye = fetch_eye(hit_patch);
  vec3 normal = vec3(-plane.xy, 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  // Relative to the centre, so that it does not matter how far away the eye is.
  vec2 pixels = gl_FragCoord.xy - seen_at.xy;
  vec3 ray = eye.xyz;
  vec3 toward = ray;
  vec3 across = to_grid(info, pixels.x * frame.ray_x.xyz + pixels.y * frame.ray_y.xyz);
  vec3 offset = across - dot(normal, across) / dot(normal, ray) * ray;
  float value = seen_at.z - info.axis_u.w * dot(ray, offset) / frame.ray_along.w;
  float depth = depth_of_value(value);
  vec3 position = disc.xyz + offset;
  bool before_eye = true;  // a disc that reaches behind the near plane is no sprite
#else
  vec3 ray = to_grid(info, ray_through(gl_FragCoord.xy));  // of unit depth
  float depth = dot(normal, disc.xyz) / dot(normal, ray);
  vec3 toward = depth * ray;
  vec3 offset = toward - disc.xyz;
  float value = frame.ray_origin.w / depth;
  vec3 position = eye.xyz + toward;
  bool before_eye = depth > 0.0;
#endif
  vec4 footprint = RELIEF_FOOTPRINT(offset.xy);
  // In this form an undefined depth (a ray within the plane) is discarded too.
  RELIEF_DISCARD_IF(!(before_eye && dot(offset, offset) <= disc.w * disc.w &&
                      within_limits(offset.xy, limits)));

  gl_FragDepth = set_back(value, plane.z);
  float along = 0.0;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CORRECTED) != 0u
  RELIEF_DISCARD_IF(!correct(position, toward, info, along));
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_MASKED) != 0u
  RELIEF_DISCARD_IF(!within_mask(info, position.xy));
#endif
  seen_from_behind = dot(normal, toward) > 0.0;
  shade(info, position, ray, depth_beyond(depth, along, info.axis_u.w), footprint);
  RELIEF_DISCARD_LOST;
}
