// Fragment stage of sprites: where the pixel's ray meets the plane (screen_frame.glsl).
#include "include/patches.glsl"

layout(location = 0) flat in vec4 frame_of_offset;
layout(location = 1) flat in vec4 middle;
layout(location = 2) flat in vec2 depths;  // of the plane's origin; set-back of depth values

struct PlaceInPlane {
  vec2 position;
  float nearness;  // 1 / depth along the view axis; orthographic the depth value; not above 0: not
                   // seen
};

float value_at(PlaceInPlane hit) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return hit.nearness;
#else
  return frame.ray_origin.w * hit.nearness;
#endif
}

float depth_at(PlaceInPlane hit) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return depth_of_value(hit.nearness);
#else
  return 1.0 / hit.nearness;
#endif
}

PlaceInPlane cast_ray() {
  vec2 offset = gl_FragCoord.xy - middle.xy;
  vec2 scaled = offset.x * frame_of_offset.xy + offset.y * frame_of_offset.zw;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return PlaceInPlane(scaled, depths.x + dot(middle.zw, scaled));
#else
  float share = 1.0 - dot(middle.zw, scaled);
  return PlaceInPlane(scaled / share, share / depths.x);
#endif
}
