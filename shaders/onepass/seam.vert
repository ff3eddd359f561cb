// The triangles between patches that end where others begin.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_SEAM_VERTICES) uniform samplerBuffer seam_vertices;

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame

void main() {
  int vertex = 2 * gl_VertexID;
  vec4 own = texelFetch(seam_vertices, vertex);
  hit_patch = patch_index;
  hit = own.xyz;
  // One patch places the vertex for all that share it: to the last bit the same position.
  uint owner = uint(int(patch_index) + int(own.w));
  gl_Position = fetch_clip_from_grid(owner) * vec4(texelFetch(seam_vertices, vertex + 1).xyz, 1.0);
}
