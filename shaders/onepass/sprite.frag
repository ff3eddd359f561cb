// Casts the view ray at the splat's disc.
#include "include/counting.glsl"
#include "include/limits.glsl"
#include "include/surface.glsl"
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

// The vertex stage gives the nearest point of the disc, so that a GPU can still reject early.
layout(depth_less) out float gl_FragDepth;

void main() {
  count_fragment();
  PatchInfo info = fetch_patch(hit_patch);
  vec3 world_ray = ray_through(gl_FragCoord.xy);
  vec3 ray = vec3(dot(world_ray, info.axis_u.xyz), dot(world_ray, info.axis_v.xyz),
                  dot(world_ray, info.axis_n.xyz)) / info.axis_u.w;  // of unit depth
  vec3 normal = vec3(-plane.xy, 1.0);
  float depth = dot(normal, disc.xyz) / dot(normal, ray);
  vec3 offset = depth * ray - disc.xyz;
  vec4 footprint = RELIEF_FOOTPRINT(offset.xy);
  // In this form an undefined depth (a ray within the plane) is discarded too.
  if (!(depth > 0.0 && dot(offset, offset) <= disc.w * disc.w &&
        within_limits(offset.xy, limits)))
    discard;

  gl_FragDepth = frame.ray_origin.w / depth * plane.z;
  vec3 place = fetch_eye(hit_patch) + depth * ray;
  float along = 0.0;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CORRECTED) != 0u
  if (!correct(place, depth * ray, info, along)) discard;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_MASKED) != 0u
  if (!within_mask(info, place.xy)) discard;
#endif
  shade(info, place, ray, depth * (1.0 + along), footprint);
}
