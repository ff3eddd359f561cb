// Which sheets of a grid a ray meets.

/// Where the ray is within `reach` of the sheets' nodes, from the middle sheet on.
vec2 sheets_met(vec2 on_middle, vec2 slope, float reach, vec2 size) {
  // A ray across the sheets has a slope of a little more than 0: its ends are far away.
  vec2 per_slope = 1.0 / mix(slope, vec2(1e-9), lessThan(abs(slope), vec2(1e-9)));
  vec2 a = (vec2(-reach) - on_middle) * per_slope;
  vec2 b = (size - 1.0 + reach - on_middle) * per_slope;
  vec2 low = min(a, b);
  vec2 high = max(a, b);
  return vec2(max(low.x, low.y), min(high.x, high.y));
}
