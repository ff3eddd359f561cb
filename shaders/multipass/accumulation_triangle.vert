// Pass 2: the triangle about a splat's disc, in its plane.
#include "multipass/clip_range.glsl"
#include "include/side.glsl"
#include "multipass/discs.glsl"
#include "multipass/splat_attributes.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) out vec2 position;  // in the disc, of radius 1
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
layout(location = 11) flat out float clipped_back;
#endif

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  PatchInfo info = fetch_patch(patch_index);
  Splat splat = fetch_splat(gl_VertexID / 3, info, clip_from_grid, fetch_eye(patch_index));
  float radius = blending_radius(splat, info);
  DiscAxes axes = disc_axes(splat.slope);
  write_clip_range(gl_VertexID / 3, splat, info);
  write_side(facing_along(splat, fetch_eye(patch_index)));
  write_attributes(patch_index, info, splat.centre.xy, radius * vec4(axes.u.xy, axes.v.xy));
  int corner = gl_VertexID % 3;
  position = corner == 2 ? vec2(0.0, 2.0) : vec2(corner == 0 ? -sqrt(3.0) : sqrt(3.0), -1.0);
  gl_Position =
      clip_from_grid *
      vec4(splat.centre + radius * (position.x * axes.u + position.y * axes.v), 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  clipped_back = clip_set_back(splat, info, fetch_eye(patch_index));
  gl_Position.z = set_back(gl_Position.z, clipped_back);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_LARGE_SPRITES) != 0u
  SpriteBox box = bound_disc(splat, radius, clip_from_grid);
  if (box.drawable || !box.visible) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
