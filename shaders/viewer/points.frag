// The points of a scan: squares of their colour.
#include "include/shared.h"

in vec3 shown_colour;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

void main() {
  out_colour = vec4(shown_colour, 1.0);
}
