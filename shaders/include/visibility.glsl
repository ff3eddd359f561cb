// What was found at a pixel: the patch, the position on it, and the side that is seen, in two words.
#include "include/patches.glsl"

layout(location = RELIEF_UNIFORM_POSITION_STEPS) uniform float position_steps;  // a cell

// `position`: grid coordinates; what lies farther beyond the patch than can be noted becomes its edge
// anyway.
uvec2 pack_position(vec2 position, uint patch_index, bool from_behind) {
  uvec2 steps = uvec2(clamp((position + kVisibilityBegin) * position_steps, 0.0, float(kVisibilityMask)));
  uint behind = from_behind ? kVisibilityBehind : 0u;
  return steps | uvec2(patch_index << kVisibilityBits,
                       (patch_index >> kVisibilityPatchBits) << kVisibilityBits | behind);
}

vec2 unpack_position(uvec2 found) {
  return vec2(found & kVisibilityMask) / position_steps - kVisibilityBegin;
}

uint unpack_patch(uvec2 found) {
  uint upper = (found.y & ~kVisibilityBehind) >> kVisibilityBits;
  return found.x >> kVisibilityBits | upper << kVisibilityPatchBits;
}

bool unpack_from_behind(uvec2 found) {
  return (found.y & kVisibilityBehind) != 0u;
}
