// Pass 1: a triangle twice as large as the splat's parallelogram, whose half the fragment stage cuts
// off: llvmpipe draws one triangle and three vertices in 0.7 of the time of two and four.
#include "multipass/clip_range.glsl"
#include "include/side.glsl"
#include "multipass/discs.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) out vec2 position;  // in the parallelogram: 0 to 1
layout(location = 1) out vec2 node;   // in the grid
layout(location = 2) flat out uint hit_patch;

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  PatchInfo info = fetch_patch(patch_index);
  Splat splat = fetch_splat(gl_VertexID / 3, info, clip_from_grid, fetch_eye(patch_index));
  int corner = gl_VertexID % 3;
  vec4 reach = splat.reach + splat.margin;
  position = vec2(corner == 1 ? 2.0 : 0.0, corner == 2 ? 2.0 : 0.0);
  vec2 offset = mix(-reach.xz, reach.yw, position);
  node = splat.centre.xy + offset;
  hit_patch = patch_index;
  write_clip_range(gl_VertexID / 3, splat, info);
  write_side(facing_along(splat, fetch_eye(patch_index)));
  gl_Position =
      clip_from_grid * vec4(splat.centre + vec3(offset, dot(offset, splat.slope)), 1.0);
  gl_Position.z = set_back(gl_Position.z, visibility_set_back(splat, info));
#if (RELIEF_FEATURES & RELIEF_FEATURE_LARGE_SPRITES) != 0u
  SpriteBox box = bound_disc(splat, covering_radius(splat), clip_from_grid);
  if (box.drawable || !box.visible) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
