// Fragment stage of sprites: where the pixel's ray meets the plane (screen_frame.glsl).
#include "include/patches.glsl"

layout(location = 0) flat in vec4 frame_of_offset;
layout(location = 1) flat in vec4 middle;
layout(location = 2) flat in vec2 depths;  // of the plane's origin; factor on depth values

struct PlaceInPlane {
  vec2 place;
  float nearness;  // 1 / depth along the view axis; not above 0: behind the eye
};

PlaceInPlane cast_ray() {
  vec2 offset = gl_FragCoord.xy - middle.xy;
  vec2 scaled = offset.x * frame_of_offset.xy + offset.y * frame_of_offset.zw;
  float share = 1.0 - dot(middle.zw, scaled);
  return PlaceInPlane(scaled / share, share / depths.x);
}
