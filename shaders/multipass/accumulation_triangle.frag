// Pass 2: rasterising the triangle has intersected the view ray with the splat's plane.
#include "multipass/accumulation.glsl"

layout(location = 0) in vec2 position;

void main() {
  count_fragment();
  vec4 footprint = RELIEF_DISC_FOOTPRINT(position);
  if (is_off(position)) discard;
  accumulate(position, RELIEF_FRAGMENT_DEPTH, footprint);
}
