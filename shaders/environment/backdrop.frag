// The environment behind the model. Coverage stays 0: that is the model's.
#include "include/patches.glsl"
#include "include/environment.glsl"

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;
// The other outputs as they were cleared: what a shader does not write is undefined.
layout(location = RELIEF_OUT_NORMAL) out vec4 out_normal;
layout(location = RELIEF_OUT_DEPTH) out float out_depth;
layout(location = RELIEF_OUT_UV) out vec2 out_uv;
layout(location = RELIEF_OUT_PATCH) out uint out_patch;

void main() {
  vec3 ray = ray_through(gl_FragCoord.xy);
  out_colour = vec4(texture(environment, to_environment(frame, ray)).rgb, 0.0);
  out_normal = vec4(0.0);
  out_depth = uintBitsToFloat(0x7F800000u);  // infinity
  out_uv = vec2(0.0);
  out_patch = 0u;
}
