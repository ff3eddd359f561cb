// Fragment stage: where a disc ends before its radius does (splats.glsl: disc_limits).
bool within_limits(vec2 offset, vec4 limits) {
  return all(lessThanEqual(vec4(-offset.x, offset.x, -offset.y, offset.y), limits));
}
