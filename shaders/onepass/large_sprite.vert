// The samples whose sprite OpenGL can't draw (too large, or reaching behind the eye), as quads in
// the splat's plane about its disc. All others are moved away.
#include "include/splats.glsl"
#include "include/sprites.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) out vec3 hit;  // in the grid frame
layout(location = 2) flat out vec4 disc;
layout(location = 3) flat out vec4 limits;

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  Splat splat = fetch_splat(gl_VertexID >> 2, fetch_patch(patch_index), clip_from_grid,
                           fetch_eye(patch_index));
  float radius = splat_radius(splat);
  SpriteBox box = bound_disc(splat, radius, clip_from_grid);
  hit_patch = patch_index;
  disc = vec4(splat.centre, radius);
  limits = disc_limits(splat);
  // The square over the disc's shadow holds the disc.
  hit = splat_corner(splat, vec4(radius), gl_VertexID & 3);
  gl_Position = clip_from_grid * vec4(hit, 1.0);
  gl_Position.z = set_back(gl_Position.z, splat.set_back);
  if (box.drawable || !box.visible) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}
