// Puts the layers over what is behind them.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_VISIBILITY) uniform sampler2D layers;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;  // premultiplied

void main() {
  out_colour = texelFetch(layers, ivec2(gl_FragCoord.xy), 0);
}
