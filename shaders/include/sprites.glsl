// Vertex stage: the square on the screen that holds a splat's disc.

// Unit vectors at right angles in a splat's plane, in the grid frame.
struct DiscAxes {
  vec3 u;
  vec3 v;
};

DiscAxes disc_axes(vec2 slope) {
  vec3 normal = vec3(-slope, 1.0);
  DiscAxes axes;
  axes.u = normalize(abs(slope.x) > abs(slope.y) ? cross(normal, vec3(0.0, 1.0, 0.0))
                                                 : cross(normal, vec3(1.0, 0.0, 0.0)));
  axes.v = normalize(cross(normal, axes.u));
  return axes;
}

struct SpriteBox {
  vec2 centre;    // normalised device coordinates
  float size;     // pixels
  float nearest;  // depth value of the disc's nearest point, not set back
  bool visible;   // false: all of it is outside the image
  bool drawable;  // as a sprite: visible, in front of the eye and within OpenGL's largest point
};

// Exact bounds of the projected disc (Weyrich et al. 2007, from the dual conic of the disc), taken
// relative to its projected centre so that a small disc far from the middle of the image does not
// cancel away. Clipped to the image: OpenGL drops points whose centre lies outside.
SpriteBox bound_disc(Splat splat, float radius, mat4 clip_from_grid) {
  DiscAxes axes = disc_axes(splat.slope);
  vec4 c = clip_from_grid * vec4(splat.centre, 1.0);
  vec4 du = clip_from_grid * vec4(radius * axes.u, 0.0);
  vec4 dv = clip_from_grid * vec4(radius * axes.v, 0.0);

  SpriteBox box;
  float reach = du.w * du.w + dv.w * dv.w;  // squared change of depth toward the disc's rim
  float d = c.w * c.w - reach;
  vec2 middle = c.xy / c.w;
  vec2 pu = du.xy - middle * du.w;
  vec2 pv = dv.xy - middle * dv.w;
  vec2 shift = (pu * du.w + pv * dv.w) / d;
  vec2 extent = sqrt(shift * shift + (pu * pu + pv * pv) / d);
  vec2 low = max(middle - shift - extent, vec2(-1.0));
  vec2 high = min(middle - shift + extent, vec2(1.0));
  bool in_front = c.w > 0.0 && d > 1e-6 * c.w * c.w;
  box.visible = !in_front || (low.x <= high.x && low.y <= high.y);
  box.centre = 0.5 * (low + high);
  vec2 pixels = 0.5 * (high - low) * frame.viewport.xy;
  box.size = max(pixels.x, pixels.y) + 0.125;  // corners are snapped to 1/256 pixel
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  box.nearest = c.z + length(vec2(du.z, dv.z));
#else
  box.nearest = frame.ray_origin.w / (c.w - sqrt(reach));
#endif
  box.drawable = in_front && box.visible && box.size <= frame.ray_y.w && box.nearest <= 1.0;
  return box;
}
