// The tables that the vertex and the fragment stage read.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_PATCHES) uniform isamplerBuffer patch_table;
layout(binding = RELIEF_TEXTURE_PATCH_VIEWS) uniform samplerBuffer patch_views;
layout(std140, binding = RELIEF_BIND_FRAME) uniform FrameBlock {
  Frame frame;
};

#include "include/projection.glsl"

// What a shader does not use of it is never read.
PatchInfo fetch_patch(uint patch_index) {
  int row = int(patch_index) * kPatchInfoRows;
  PatchInfo info;
  info.axis_u = intBitsToFloat(texelFetch(patch_table, row));
  info.axis_v = intBitsToFloat(texelFetch(patch_table, row + 1));
  info.axis_n = intBitsToFloat(texelFetch(patch_table, row + 2));
  info.nodes = texelFetch(patch_table, row + 3);
  info.heights = texelFetch(patch_table, row + 4);
  info.normals = texelFetch(patch_table, row + 5);
  info.colours = texelFetch(patch_table, row + 6);
  info.masks = texelFetch(patch_table, row + 7);
  info.extent = intBitsToFloat(texelFetch(patch_table, row + 8));
  return info;
}

mat4 fetch_clip_from_grid(uint patch_index) {
  int row = int(patch_index) * kPatchViewRows;
  return mat4(texelFetch(patch_views, row), texelFetch(patch_views, row + 1),
              texelFetch(patch_views, row + 2), texelFetch(patch_views, row + 3));
}

// The position on the patch nearest to grid coordinates `position`.
vec2 clamp_to_patch(PatchInfo info, vec2 position) {
  return clamp(position, info.extent.xx, info.extent.yz);
}

// The eye in the grid frame (PatchView::eye).
vec4 fetch_eye(uint patch_index) {
  return texelFetch(patch_views, int(patch_index) * kPatchViewRows + 4);
}

// Whether a pass that shades later has to be told how far away the surface is.
#define RELIEF_NEEDS_DEPTH \
  ((RELIEF_FEATURES & (RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS | \
                       RELIEF_FEATURE_TWO_INTERFACES)) != 0u)
