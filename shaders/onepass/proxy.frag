// The outputs of a model seen from afar, which its vertices have.
#include "include/counting.glsl"

layout(location = 0) in vec3 colour;
layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
layout(location = 1) in vec3 normal;
layout(location = RELIEF_OUT_NORMAL) out vec4 out_normal;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
layout(location = 2) in float depth;
layout(location = RELIEF_OUT_DEPTH) out float out_depth;
#endif
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0u
layout(location = 3) flat in uvec3 source;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
layout(location = RELIEF_OUT_UV) out vec2 out_uv;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
layout(location = RELIEF_OUT_PATCH) out uint out_patch;
#endif

void main() {
  count_fragment();
  out_colour = vec4(colour, 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
  out_normal = vec4(normalize(normal), 0.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
  out_depth = depth;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
  out_uv = vec2(source.yz);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
  out_patch = source.x;
#endif
}
