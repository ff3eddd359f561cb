// The bench's mesh: normals interpolated over triangles, and the scene's material.
#include "include/counting.glsl"
#include "include/maps.glsl"
#include "include/materials.glsl"

layout(location = 0) in vec3 seen_normal;
layout(location = 1) in vec3 ray;
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(location = 2) in vec3 seen_colour;
#endif
layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

void main() {
  count_fragment();
  vec3 albedo = vec3(kNeutralGrey);
  vec3 normal = vec3(0.0);
  vec3 view = vec3(0.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  albedo = seen_colour;
#endif
#if RELIEF_NEEDS_NORMAL
  normal = normalize(seen_normal);
  view = normalize(ray);
#endif
  out_colour = vec4(shade_material(0, albedo, normal, view, RELIEF_FRAGMENT_DEPTH), 1.0);
}
