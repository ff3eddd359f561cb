// A model seen from afar, as a mesh of means of its samples.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_FAR_VERTICES) uniform usamplerBuffer far_vertices;

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) out vec3 mean_normal;  // world
layout(location = 1) flat out int material;
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(location = 2) out vec3 colour;
#endif
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0u
layout(binding = RELIEF_TEXTURE_FAR_SOURCES) uniform usamplerBuffer far_sources;
layout(location = 3) flat out uvec3 source;  // patch id + 1, column, row
#endif

vec3 unit_from_octahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.xy += mix(vec2(fold), vec2(-fold), greaterThanEqual(n.xy, vec2(0.0)));
  return normalize(n);
}

void main() {
  PatchInfo info = fetch_patch(patch_index);
  uvec4 record = texelFetch(far_vertices, gl_VertexID);
  vec3 place = vec3(record.x & 0xFFFFu, record.x >> 16, record.y & 0xFFFFu);
  vec2 octahedral = vec2(record.w & 0xFFFu, (record.w >> 12) & 0xFFFu) * (2.0 / 4095.0) - 1.0;
  vec3 local = float(record.w >> 24) / 255.0 * unit_from_octahedral(octahedral);
  mean_normal = info.axis_u.xyz * local.x + info.axis_v.xyz * local.y + info.axis_n.xyz * local.z;
  material = info.heights.w;
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  colour = vec3(unpackHalf2x16(record.y).y, unpackHalf2x16(record.z));
#endif
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0u
  uvec2 sample_of = texelFetch(far_sources, gl_VertexID).xy;
  source = uvec3(uint(info.nodes.z) + sample_of.x + 1u, sample_of.y & 0xFFFFu, sample_of.y >> 16);
#endif
  gl_Position = fetch_clip_from_grid(patch_index) * vec4(place, 1.0);
}
