// A quad per sample: gl_VertexID / 4 is the record, gl_VertexID % 4 the corner.
#include "include/splats.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  Splat splat = fetch_splat(gl_VertexID >> 2, fetch_patch(patch_index), clip_from_grid,
                           fetch_eye(patch_index));
  hit_patch = patch_index;
  hit = splat_corner(splat, splat.reach + splat.margin, gl_VertexID & 3);
  gl_Position = clip_from_grid * vec4(hit, 1.0);
  gl_Position.z = set_back(gl_Position.z, splat.set_back);
}
