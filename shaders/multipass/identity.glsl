// Fragment stage of pass 1: the outputs that can't be blended are those of the splat in front.
#include "include/patches.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
layout(location = RELIEF_OUT_UV) out vec2 out_uv;  // grid coordinates
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
layout(location = RELIEF_OUT_PATCH) out uint out_patch;  // id + 1
#endif

void write_identity(uint patch_index, vec2 place) {
  // Unused, and never read, without those outputs.
  PatchInfo info = fetch_patch(patch_index);
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
  out_uv = clamp(place, vec2(0.0), vec2(info.nodes.xy - 1));
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
  out_patch = uint(info.nodes.z) + 1u;
#endif
}
