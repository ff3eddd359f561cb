// What was found at a pixel: the patch and the position on it, in two words.
#include "include/patches.glsl"

layout(location = RELIEF_UNIFORM_POSITION_STEPS) uniform float position_steps;  // a cell

// `position`: grid coordinates; what lies farther beyond the patch than can be noted becomes its edge
// anyway.
uvec2 pack_position(vec2 position, uint patch_index) {
  uvec2 steps = uvec2(clamp((position + kVisibilityBegin) * position_steps, 0.0, float(kVisibilityMask)));
  return steps | uvec2(patch_index << kVisibilityBits, (patch_index >> kVisibilityPatchBits) << kVisibilityBits);
}

vec2 unpack_position(uvec2 found) {
  return vec2(found & kVisibilityMask) / position_steps - kVisibilityBegin;
}

uint unpack_patch(uvec2 found) {
  return found.x >> kVisibilityBits | (found.y >> kVisibilityBits) << kVisibilityPatchBits;
}
