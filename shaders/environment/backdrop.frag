// The environment behind the model. Coverage stays 0: that is the model's.
#include "include/patches.glsl"
#include "include/environment.glsl"

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

void main() {
  vec3 ray = frame.ray_origin.xyz + gl_FragCoord.x * frame.ray_x.xyz +
             gl_FragCoord.y * frame.ray_y.xyz;
  out_colour = vec4(texture(environment, ray).rgb, 0.0);
}
