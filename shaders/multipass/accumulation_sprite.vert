// Pass 2: a point sprite that holds the splat's disc.
#include "multipass/clip_range.glsl"
#include "include/side.glsl"
#include "multipass/discs.glsl"
#include "multipass/screen_frame.glsl"
#include "multipass/splat_attributes.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out vec4 frame_of_offset;
layout(location = 1) flat out vec4 middle;
layout(location = 2) flat out vec2 depths;

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  PatchInfo info = fetch_patch(patch_index);
  Splat splat = fetch_splat(gl_VertexID, info, clip_from_grid, fetch_eye(patch_index));
  float radius = blending_radius(splat, info);
  DiscAxes axes = disc_axes(splat.slope);
  write_clip_range(gl_VertexID, splat, info);
  write_side(facing_along(splat, fetch_eye(patch_index)));
  write_attributes(patch_index, info, splat.centre.xy, radius * vec4(axes.u.xy, axes.v.xy));
  ScreenFrame seen =
      project_frame(splat.centre, radius * axes.u, radius * axes.v, clip_from_grid);
  frame_of_offset = seen.frame_of_offset;
  middle = seen.middle;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  depths = vec2(seen.depth, clip_set_back(splat, info, fetch_eye(patch_index)));
#else
  depths = vec2(seen.depth, 1.0);
#endif
  SpriteBox box = bound_disc(splat, radius, clip_from_grid);
  gl_Position = box.drawable ? vec4(box.centre, box.nearest, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  gl_PointSize = box.size;
#if (RELIEF_FEATURES & RELIEF_FEATURE_FRONT) != 0u
  if (is_hidden_back(splat, fetch_eye(patch_index))) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
