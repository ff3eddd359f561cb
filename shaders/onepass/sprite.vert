// A point sprite per sample (section 3.4 of paper 001), just large enough for its disc.
#include "include/splats.glsl"
#include "include/sprites.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) flat out vec4 disc;   // centre relative to the eye, in the grid frame; radius
layout(location = 2) flat out vec3 plane;  // slope, set-back
layout(location = 3) flat out vec4 limits;

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  Splat splat = fetch_splat(gl_VertexID, fetch_patch(patch_index), clip_from_grid,
                           fetch_eye(patch_index));
  float radius = splat_radius(splat);
  hit_patch = patch_index;
  disc = vec4(splat.centre - fetch_eye(patch_index), radius);
  plane = vec3(splat.slope, splat.set_back);
  limits = disc_limits(splat);

  SpriteBox box = bound_disc(splat, radius, clip_from_grid);
  // What is not drawn here goes behind the near plane.
  gl_Position = box.drawable ? vec4(box.centre, box.nearest, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  gl_PointSize = box.size;
}
