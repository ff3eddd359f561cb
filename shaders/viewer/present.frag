// From a picture in linear light to what a window shows, sRGB.
#include "include/shared.h"
#include "include/srgb.glsl"

layout(binding = RELIEF_TEXTURE_PIXEL_SAMPLES) uniform sampler2D picture;

layout(location = RELIEF_UNIFORM_EXPOSURE) uniform float exposure;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

void main() {
  vec3 light = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
  out_colour = vec4(srgb_of(exposure * light), 1.0);
}
