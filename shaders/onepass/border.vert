// Cells that holes cut, as fans of three triangles: gl_VertexID / kBorderVertices is the record.
#include "include/heights.glsl"

layout(binding = RELIEF_TEXTURE_BORDER_CELLS) uniform usamplerBuffer border_cells;

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;
layout(location = RELIEF_ATTRIBUTE_CORNER) in uint part_corner;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame

// A node of a cell, counterclockwise from the lower left.
ivec2 corner_of(int k) {
  return ivec2(k == 1 || k == 2 ? 1 : 0, k >= 2 ? 1 : 0);
}

// The place among the slots of the corner of a polygon.
int slot_of(uint slots, int corner) {
  for (int before = 0; before < corner; ++before) slots &= slots - 1u;
  return findLSB(slots);
}

// A sample, and what lies `way` beyond it along `toward`, on the slope that leads to it.
vec3 position_beyond(PatchInfo info, ivec2 node, ivec2 toward, float way) {
  float height = float(fetch_height(info, node)) * info.axis_v.w;
  uint before = fetch_height(info, node - toward);
  float rise = height - float(before) * info.axis_v.w;
  bool continued = before != kHoleTexel && abs(rise) <= kSteepest;
  if (!continued) rise = 0.0;
  way *= inversesqrt(1.0 + rise * rise);
  return vec3(vec2(node) + way * vec2(toward), height + way * rise);
}

void main() {
  PatchInfo info = fetch_patch(patch_index);
  uvec2 border = texelFetch(border_cells, gl_VertexID / kBorderVertices).xy;
  ivec2 cell = ivec2(part_corner & 0xFFFFu, part_corner >> 16) - 1 +
               ivec2(border.x & kNodeInPartMask, (border.x >> kNodeInPartBits) & kNodeInPartMask);
  uint slots = (border.x >> kBorderSlotsShift) & 0xFFu;
  int vertex = gl_VertexID % kBorderVertices;
  int corner = vertex % 3 == 0 ? 0 : min(vertex / 3 + vertex % 3, bitCount(slots) - 1);
  int slot = slot_of(slots, corner);
  int k = slot / 2;
  int next = (k + 1) & 3;
  bool from_next = (slots & (1u << (2 * k))) == 0u;  // an edge from a hole to a sample
  ivec2 node = cell + corner_of(slot % 2 == 1 && from_next ? next : k);
  ivec2 toward = ivec2(0);
  if (slot % 2 == 1) toward = cell + corner_of(from_next ? k : next) - node;
  float way = kBorderStep * float((border.y >> (8 * k)) & 0xFFu);
  hit_patch = patch_index;
  hit = position_beyond(info, node, toward, slot % 2 == 1 ? way : 0.0);
  gl_Position = fetch_clip_from_grid(patch_index) * vec4(hit, 1.0);
  // As border splats: where patches overlap, what is farther from its border is the better surface.
  float behind = kSetBackStep * float(border.x >> kBorderSetBackShift) * info.axis_u.w;
  if (gl_Position.w > 0.0)
    gl_Position.z = set_back(gl_Position.z, set_back_of(gl_Position.w, behind));
}
