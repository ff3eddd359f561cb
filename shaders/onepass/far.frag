// Shades a model seen from afar.
#define RELIEF_MEAN_NORMALS
#include "include/counting.glsl"
#include "include/maps.glsl"
#include "include/materials.glsl"

layout(location = 0) in vec3 mean_normal;
layout(location = 1) flat in int material;
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(location = 2) in vec3 colour;
#else
const vec3 colour = vec3(kNeutralGrey);
#endif
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0u
layout(location = 3) flat in uvec3 source;
#endif

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
layout(location = RELIEF_OUT_NORMAL) out vec4 out_normal;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
layout(location = RELIEF_OUT_DEPTH) out float out_depth;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
layout(location = RELIEF_OUT_UV) out vec2 out_uv;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
layout(location = RELIEF_OUT_PATCH) out uint out_patch;
#endif

void main() {
  count_fragment();
  float depth = 1.0 / gl_FragCoord.w;
  vec3 ray = normalize(ray_through(gl_FragCoord.xy));
  normal_length = max(length(mean_normal), 1e-3);  // those of opposite sides may cancel
  vec3 normal = mean_normal / normal_length;
  out_colour = vec4(shade_material(material, colour, normal, ray, depth), 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
  out_normal = vec4(normal, 0.0);
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
