// Fragment stage: the outputs that say where on which patch a fragment lies.
#include "include/patches.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
layout(location = RELIEF_OUT_UV) out vec2 out_uv;  // grid coordinates
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
layout(location = RELIEF_OUT_PATCH) out uint out_patch;  // id + 1
#endif

// `position`: grid coordinates; those beyond the patch become its edge.
void write_identity(PatchInfo info, vec2 position) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_UV) != 0u
  out_uv = info.extent.w * (clamp_to_patch(info, position) - info.extent.x);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_PATCH) != 0u
  out_patch = uint(info.nodes.z) + 1u;
#endif
}
