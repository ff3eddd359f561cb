// Vertex stage: which lines clip a splat.
#include "include/splats.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
layout(binding = RELIEF_TEXTURE_CLIP_RANGES) uniform usamplerBuffer clip_ranges;

layout(location = 8) flat out uvec2 clip_range;  // as shared.h says of records
layout(location = 9) flat out vec3 clip_centre;  // of the splat, grid coordinates; slack in cells
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIP_WICKE) != 0u
layout(location = 10) flat out vec2 clip_slope;
#endif

void write_clip_range(int record, Splat splat, PatchInfo info) {
  clip_range = texelFetch(clip_ranges, record).xy;
  float pixel = max(splat.depth, 0.0) / (frame.ray_x.w * info.axis_u.w);
  clip_centre = vec3(splat.centre.xy, kClipSlack + kClipSlackPixels * pixel);
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIP_WICKE) != 0u
  clip_slope = splat.slope;
#endif
}

// What sets a clipped splat that faces away back in pass 2, a little less than pass 1 does. Behind a
// sharp edge the face that faces away begins where the one that is seen ends: with the blending depth
// of all others it would shine through there.
float clip_set_back(Splat splat, PatchInfo info, vec4 eye) {
  vec3 ray = ray_toward(splat.centre, eye);
  bool faces_away = ray.z - dot(splat.slope, ray.xy) >= 0.0;
  if (!faces_away || (clip_range.y >> kClipKindBits) == 0u) return kNotSetBack;
  float offset = kClippedSetBack * kBlendingDepth * info.axis_u.w;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return splat.set_back + set_back_of(splat.depth, offset);
#else
  return splat.set_back * set_back_of(max(splat.depth, 0.0), offset);
#endif
}
#else
void write_clip_range(int record, Splat splat, PatchInfo info) {}
#endif
