// Cells of patches that meet others, as indexed strips of triangles: gl_VertexID is a node of the
// part. Nothing overlaps them, so that nothing is set back.
#include "include/heights.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;
layout(location = RELIEF_ATTRIBUTE_CORNER) in uint part_corner;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame

void main() {
  PatchInfo info = fetch_patch(patch_index);
  uint within = uint(gl_VertexID);
  ivec2 node = ivec2(part_corner & 0xFFFFu, part_corner >> 16) +
               ivec2(within & kStripColumnMask, within >> kStripRowShift);
  hit_patch = patch_index;
  hit = vec3(node, float(fetch_height(info, node)) * info.axis_v.w);
  gl_Position = fetch_clip_from_grid(patch_index) * vec4(hit, 1.0);
}
