// The mean of a pixel's samples, which are the texels of a square.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_PIXEL_SAMPLES) uniform sampler2D pixel_samples;

// The part's lower left corner in the image; samples along a pixel's side.
layout(location = RELIEF_UNIFORM_PART) uniform ivec3 part;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

void main() {
  ivec2 first = (ivec2(gl_FragCoord.xy) - part.xy) * part.z;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < part.z; ++y) {
    for (int x = 0; x < part.z; ++x) sum += texelFetch(pixel_samples, first + ivec2(x, y), 0);
  }
  out_colour = sum / float(part.z * part.z);
}
