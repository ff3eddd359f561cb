// What was found at a pixel: the patch and the place on it, in two words.
#include "include/patches.glsl"

layout(location = RELIEF_UNIFORM_PLACE_STEPS) uniform float place_steps;  // a cell

// `place`: grid coordinates; what lies farther beyond the patch than can be noted becomes its edge
// anyway.
uvec2 pack_place(vec2 place, uint patch_index) {
  uvec2 steps = uvec2(clamp((place + kVisibilityBegin) * place_steps, 0.0, float(kVisibilityMask)));
  return steps | uvec2(patch_index << kVisibilityBits, (patch_index >> kVisibilityPatchBits) << kVisibilityBits);
}

vec2 unpack_place(uvec2 found) {
  return vec2(found & kVisibilityMask) / place_steps - kVisibilityBegin;
}

uint unpack_patch(uvec2 found) {
  return found.x >> kVisibilityBits | (found.y >> kVisibilityBits) << kVisibilityPatchBits;
}
