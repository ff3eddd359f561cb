// Pass 2: rasterising the triangle has intersected the view ray with the splat's plane.
#include "multipass/accumulation.glsl"

layout(location = 0) in vec2 position;

// Depths of the splat, which an orthographic camera's depth values have set back.
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u && \
    (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
layout(location = 11) flat in float clipped_back;
#define RELIEF_DISC_DEPTH depth_of_value(gl_FragCoord.z + clipped_back)
#else
#define RELIEF_DISC_DEPTH RELIEF_FRAGMENT_DEPTH
#endif

void main() {
  count_fragment();
  vec4 footprint = RELIEF_DISC_FOOTPRINT(position);
  if (is_off(position)) discard;
  accumulate(position, RELIEF_DISC_DEPTH, footprint);
}
