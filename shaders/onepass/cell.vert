// Runs of cells as triangle strips: gl_VertexID / kRunVertices is the run. Each cell is halved along
// the diagonal from (0, 0) to (1, 1), as for corrected interpolation.
#include "include/heights.glsl"

layout(binding = RELIEF_TEXTURE_CELL_RUNS) uniform usamplerBuffer cell_runs;

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;
layout(location = RELIEF_ATTRIBUTE_CORNER) in uint part_corner;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame

void main() {
  PatchInfo info = fetch_patch(patch_index);
  uvec2 run = texelFetch(cell_runs, gl_VertexID / kRunVertices).xy;
  uint cells = (run.x >> (2u * kPlaceBits)) & kRunCellsMask;
  int corner = clamp(gl_VertexID % kRunVertices - 1, 0, kRunVertices - 3);
  // The upper row first: 2, 0, 3, 1 of a cell.
  uvec2 within = uvec2(min(uint(corner) / 2u, cells), 1u - uint(corner) % 2u);
  uvec2 first = uvec2(part_corner & 0xFFFFu, part_corner >> 16) +
                uvec2(run.x & kPlaceMask, (run.x >> kPlaceBits) & kPlaceMask);
  ivec2 node = ivec2(first + within);
  hit_patch = patch_index;
  hit = vec3(node, float(fetch_height(info, node)) * info.axis_v.w);
  gl_Position = fetch_clip_from_grid(patch_index) * vec4(hit, 1.0);
  // As border splats: where patches overlap, what is farther from its border is the better surface.
  bool border = ((run.y >> (2u * within.x + 1u - within.y)) & 1u) != 0u;
  float behind = border ? kSetBackStep * float(run.x >> kSetBackShift) * info.axis_u.w : 0.0;
  if (gl_Position.w > 0.0) gl_Position.z *= gl_Position.w / (gl_Position.w + behind);
}
