// A model seen from afar: a mesh of means of its samples, shaded once a vertex. (Its triangles are two
// pixels wide, and a fragment's shader is run for blocks of sixteen.)
// How far the unit normals are spread that a vertex has the mean of: the root of what their mean is
// shorter than 1.
#define RELIEF_MEAN_NORMALS
float normal_spread = 0.0;
#define RELIEF_WINDOW window
vec2 window = vec2(0.0);

#include "include/maps.glsl"
#include "include/materials.glsl"

layout(binding = RELIEF_TEXTURE_PROXY_VERTICES) uniform usamplerBuffer proxy_vertices;

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) out vec3 colour;
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
layout(location = 1) out vec3 normal;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
layout(location = 2) out float depth;
#endif
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0u
layout(binding = RELIEF_TEXTURE_PROXY_SOURCES) uniform usamplerBuffer proxy_sources;
layout(location = 3) flat out uvec3 source;  // patch id + 1, column, row
#endif

vec3 unit_from_octahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.xy += mix(vec2(fold), vec2(-fold), greaterThanEqual(n.xy, vec2(0.0)));
  return normalize(n);
}

// Along the view axis.
float depth_of(PatchInfo info, vec3 position) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  vec4 eye = fetch_eye(patch_index);
  return eye.w + info.axis_u.w * dot(eye.xyz, position);
#else
  return gl_Position.w;
#endif
}

void main() {
  PatchInfo info = fetch_patch(patch_index);
  uvec4 record = texelFetch(proxy_vertices, gl_VertexID);
  vec3 position = vec3(record.x & 0xFFFFu, record.x >> 16, record.y & 0xFFFFu);
  gl_Position = fetch_clip_from_grid(patch_index) * vec4(position, 1.0);
  window = (0.5 + 0.5 * gl_Position.xy / gl_Position.w) * frame.viewport.xy;

  vec2 octahedral = vec2(record.w & 0x1FFFu, (record.w >> 13) & 0x1FFFu) * (2.0 / 8191.0) - 1.0;
  vec3 facing = to_world(info, unit_from_octahedral(octahedral));
  normal_spread = float(record.w >> 26) / 63.0;
  float distance = depth_of(info, position);
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  vec3 albedo = vec3(unpackHalf2x16(record.y).y, unpackHalf2x16(record.z));
#else
  vec3 albedo = vec3(kNeutralGrey);
#endif
  colour = shade_material(info.heights.w, albedo, facing, normalize(ray_through(window)), distance);
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
  normal = facing;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
  depth = distance;
#endif
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0u
  uvec2 sample_of = texelFetch(proxy_sources, gl_VertexID).xy;
  source = uvec3(uint(info.nodes.z) + sample_of.x + 1u, sample_of.y & 0xFFFFu, sample_of.y >> 16);
#endif
}
