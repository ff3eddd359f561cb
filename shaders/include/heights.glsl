// The heights of a patch: from its map, or with cells from the rows that they are kept in.
#include "include/patches.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_CELL) != 0u
layout(binding = RELIEF_TEXTURE_CELL_HEIGHTS) uniform usamplerBuffer cell_heights;
layout(binding = RELIEF_TEXTURE_CELL_ROWS) uniform usamplerBuffer cell_rows;
#else
layout(binding = RELIEF_TEXTURE_HEIGHTS) uniform usampler2DArray height_maps;
#endif

// The height index of a node, kHoleTexel where there is none. Nodes may lie one column or row
// beyond the last.
uint fetch_height(PatchInfo info, ivec2 node) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_CELL) != 0u
  uvec2 row = texelFetch(cell_rows, info.nodes.w + node.y).xy;
  uint column = uint(node.x);
  bool within = column >= (row.y & 0xFFFFu) && column < row.y >> 16;
  return within ? texelFetch(cell_heights, int(row.x + column)).x : kHoleTexel;
#else
  return texelFetch(height_maps, ivec3(info.heights.xy + node, info.heights.z), 0).x;
#endif
}
