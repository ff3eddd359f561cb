// Semi-transparent surfaces one behind the other: which fragments come after the layer before.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D opaque_depth;
layout(binding = RELIEF_TEXTURE_LAYER_DEPTH) uniform sampler2D layer_depth;  // 1: there is none yet

// Whether a fragment lies behind the layer before and in front of all that is opaque. Depth values
// are reversed.
bool in_next_layers(float spacing) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = gl_FragCoord.z;
  float before = texelFetch(layer_depth, pixel, 0).x;
  if (depth >= before || depth <= texelFetch(opaque_depth, pixel, 0).x) return false;
  return before >= 1.0 || depth_of_value(depth) - depth_of_value(before) > kLayerGap * spacing;
}
