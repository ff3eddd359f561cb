// Coarser levels reach beyond the samples of their patch; its mask says where the patch ends.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_MASKS) uniform sampler2DArray masks;

// Whether the patch has a surface at grid coordinates `position` of a level: as far as its finest
// cells and splats reach.
bool within_mask(PatchInfo info, vec2 position) {
  if (info.extent.w <= 1.0) return true;
  // A texel around each mask is empty.
  vec2 texel = clamp(position, info.extent.xx - 1.0 / info.extent.w,
                     info.extent.yz + 1.0 / info.extent.w) * float(info.masks.w) + 0.5;
  vec2 uv = (vec2(info.masks.xy) + texel) / vec2(textureSize(masks, 0).xy);
  return textureLod(masks, vec3(uv, float(info.masks.z)), 0.0).r >= 0.5;
}
