// Runs of cells as triangle strips: gl_VertexID / kVertices is the run. Each cell is halved along
// the diagonal from (0, 0) to (1, 1), as for corrected interpolation.
#include "include/heights.glsl"

layout(binding = RELIEF_TEXTURE_CELL_RUNS) uniform usamplerBuffer cell_runs;

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;
layout(location = RELIEF_ATTRIBUTE_CORNER) in uint part_corner;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame

// Whether one of a node's eight neighbours lies before the first or beyond the last sample of its row.
// (What lies beside a hole within is not told, which is 0.06 dB of the Dragon, lit, and saves the four
// bytes a run that would tell.)
bool beside_border(PatchInfo info, ivec2 node) {
  bool beside = false;
  for (int row = node.y - 1; row <= node.y + 1; ++row) {
    uint span = texelFetch(cell_rows, info.nodes.w + row).y;
    beside = beside || uint(node.x) <= (span & 0xFFFFu) || uint(node.x) + 1u >= span >> 16;
  }
  return beside;
}

#if (RELIEF_FEATURES & RELIEF_FEATURE_MASKED) != 0u
const int kVertices = kEdgeRunVertices;
#else
const int kVertices = kRunVertices;
#endif

void main() {
  PatchInfo info = fetch_patch(patch_index);
  uint run = texelFetch(cell_runs, gl_VertexID / kVertices).x;
  uint cells = (run >> (2u * kNodeInPartBits)) & kRunCellsMask;
  int corner = clamp(gl_VertexID % kVertices - 1, 0, kVertices - 3);
  // The upper row first: 2, 0, 3, 1 of a cell.
  uvec2 within = uvec2(min(uint(corner) / 2u, cells), 1u - uint(corner) % 2u);
  uvec2 first = uvec2(part_corner & 0xFFFFu, part_corner >> 16) +
                uvec2(run & kNodeInPartMask, (run >> kNodeInPartBits) & kNodeInPartMask);
  ivec2 node = ivec2(first + within);
  hit_patch = patch_index;
  hit = vec3(node, float(fetch_height(info, node)) * info.axis_v.w);
  gl_Position = fetch_clip_from_grid(patch_index) * vec4(hit, 1.0);
  // As border splats: where patches overlap, what is farther from its border is the better surface.
  float behind = beside_border(info, node)
                     ? kSetBackStep * float(run >> kSetBackShift) * info.axis_u.w : 0.0;
  if (gl_Position.w > 0.0)
    gl_Position.z = set_back(gl_Position.z, set_back_of(gl_Position.w, behind));
}
