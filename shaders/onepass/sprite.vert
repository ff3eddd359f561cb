// A point sprite per sample (section 3.4 of [Ochotta 2008]), just large enough for its disc.
#include "include/splats.glsl"
#include "include/sprites.glsl"

layout(location = RELIEF_ATTRIBUTE_PATCH) in uint patch_index;

layout(location = 0) flat out uint hit_patch;
layout(location = 1) flat out vec4 disc;   // centre relative to the eye, in the grid frame; radius
                                           // (orthographic: centre in the grid frame)
layout(location = 2) flat out vec3 plane;  // slope, set-back
layout(location = 3) flat out vec4 limits;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
layout(location = 4) flat out vec3 seen_at;  // the centre's window position and depth value
#endif

void main() {
  mat4 clip_from_grid = fetch_clip_from_grid(patch_index);
  vec4 eye = fetch_eye(patch_index);
  Splat splat = fetch_splat(gl_VertexID, fetch_patch(patch_index), clip_from_grid, eye);
  float radius = splat_radius(splat);
  hit_patch = patch_index;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  disc = vec4(splat.centre, radius);
  vec4 centre = clip_from_grid * vec4(splat.centre, 1.0);
  seen_at = vec3((0.5 + 0.5 * centre.xy) * frame.viewport.xy, centre.z);
#else
  disc = vec4(splat.centre - eye.xyz, radius);
#endif
  plane = vec3(splat.slope, splat.set_back);
  limits = disc_limits(splat);

  SpriteBox box = bound_disc(splat, radius, clip_from_grid);
  // What is not drawn here goes behind the near plane.
  gl_Position = box.drawable ? vec4(box.centre, box.nearest, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
  gl_PointSize = box.size;
#if (RELIEF_FEATURES & RELIEF_FEATURE_FRONT) != 0u
  if (is_hidden_back(splat, eye)) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
