// What is shown of a canvas into the window, enlarged if it is smaller.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_PIXEL_SAMPLES) uniform sampler2D canvas;

layout(location = 0) in vec2 at;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

void main() {
  out_colour = texture(canvas, at);
}
