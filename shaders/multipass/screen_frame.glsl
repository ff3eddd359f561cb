// Vertex stage: what lets a sprite's fragments cast the view ray at a plane with few operations.
struct ScreenFrame {
  vec4 frame_of_offset;  // matrix, column by column: from pixels off the middle to the plane
  vec4 middle;           // window position of the plane's origin; change of depth along u and v
  float depth;           // of the origin, along the view axis; orthographic: depth values, both
};

// The plane centre + a u + b v (grid frame). With A = frame_of_offset (pixel - middle.xy), the ray
// meets it at (a, b) = A / (1 - middle.zw . A), at `depth` over the same; orthographic at A, at the
// depth value depth + middle.zw . A.
ScreenFrame project_frame(vec3 centre, vec3 u, vec3 v, mat4 clip_from_grid) {
  vec4 c = clip_from_grid * vec4(centre, 1.0);
  vec4 du = clip_from_grid * vec4(u, 0.0);
  vec4 dv = clip_from_grid * vec4(v, 0.0);
  vec2 position = c.xy / c.w;
  vec2 half_viewport = 0.5 * frame.viewport.xy;
  vec2 pu = half_viewport / c.w * (du.xy - position * du.w);
  vec2 pv = half_viewport / c.w * (dv.xy - position * dv.w);
  ScreenFrame seen;
  // Seen edge-on this is infinite, and no fragment meets the plane.
  seen.frame_of_offset = vec4(pv.y, -pu.y, -pv.x, pu.x) / (pu.x * pv.y - pu.y * pv.x);
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  seen.middle = vec4((1.0 + position) * half_viewport, du.z, dv.z);
  seen.depth = c.z;
#else
  seen.middle = vec4((1.0 + position) * half_viewport, vec2(du.w, dv.w) / c.w);
  seen.depth = c.w;
#endif
  return seen;
}
