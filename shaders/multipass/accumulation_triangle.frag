// Pass 2: rasterising the triangle has intersected the view ray with the splat's plane.
#include "multipass/accumulation.glsl"

layout(location = 0) in vec2 place;

void main() {
  count_fragment();
  if (dot(place, place) > 1.0) discard;
  accumulate(place, 1.0 / gl_FragCoord.w);
}
