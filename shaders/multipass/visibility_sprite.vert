// Pass 1: a point sprite that holds the splat's parallelogram.
#include "multipass/clip_range.glsl"
#include "include/side.glsl"
#include "multipass/discs.glsl"
#include "multipass/screen_frame.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out vec4 frame_of_offset;
layout(location = 1) flat out vec4 middle;
layout(location = 2) flat out vec2 depths;
layout(location = 3) flat out vec4 grid_position;  // middle of the parallelogram, half its sides
layout(location = 4) flat out uint hit_patch;

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  PatchInfo info = fetch_patch(patch_index);
  Splat splat = fetch_splat(gl_VertexID, info, clip_from_grid, fetch_eye(patch_index));
  vec4 reach = splat.reach + splat.margin;
  vec2 offset = 0.5 * (reach.yw - reach.xz);
  vec2 half_side = 0.5 * (reach.yw + reach.xz);
  ScreenFrame seen =
      project_frame(splat.centre + vec3(offset, dot(offset, splat.slope)),
                    half_side.x * vec3(1.0, 0.0, splat.slope.x),
                    half_side.y * vec3(0.0, 1.0, splat.slope.y), clip_from_grid);
  float by = visibility_set_back(splat, info);
  frame_of_offset = seen.frame_of_offset;
  middle = seen.middle;
  depths = vec2(seen.depth, by);
  grid_position = vec4(splat.centre.xy + offset, half_side);
  hit_patch = patch_index;
  write_clip_range(gl_VertexID, splat, info);
  write_side(facing_along(splat, fetch_eye(patch_index)));
  SpriteBox box = bound_disc(splat, covering_radius(splat), clip_from_grid);
  gl_Position =
      box.drawable ? vec4(box.centre, set_back(box.nearest, by), 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  gl_PointSize = box.size;
#if (RELIEF_FEATURES & RELIEF_FEATURE_FRONT) != 0u
  if (is_hidden_back(splat, fetch_eye(patch_index))) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
