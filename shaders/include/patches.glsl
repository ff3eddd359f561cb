// The tables that the vertex and the fragment stage read.
#include "include/shared.h"

layout(std430, binding = RELIEF_BIND_PATCHES) readonly buffer PatchTable {
  PatchInfo patches[];
};
layout(std430, binding = RELIEF_BIND_PATCH_VIEWS) readonly buffer PatchViews {
  PatchView patch_views[];
};
layout(std140, binding = RELIEF_BIND_FRAME) uniform FrameBlock {
  Frame frame;
};
