// Fragment stage: whether a splat is clipped where the pixel's ray meets its plane ([Ivo 2011],
// section V).
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
layout(binding = RELIEF_TEXTURE_CLIP_LINES) uniform samplerBuffer clip_lines;

layout(location = 8) flat in uvec2 clip_range;
layout(location = 9) flat in vec3 clip_centre;

bool is_beyond(vec4 line, vec2 offset, float slack) {
  return dot(line.xy, offset) > line.z + slack;
}

#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIP_WICKE) != 0u
layout(location = 10) flat in vec2 clip_slope;

struct Partner {
  vec4 line;
  vec4 centre;  // from the splat's; w: 1 if the edge between them is concave
  vec3 normal;
};

Partner fetch_partner(int k) {
  int texel = int(clip_range.x) + kWickeTexels * k;
  return Partner(texelFetch(clip_lines, texel), texelFetch(clip_lines, texel + 1),
                 texelFetch(clip_lines, texel + 2).xyz);
}

// As wicke_clips() of renderer/clip/wicke.h.
bool is_clipped(vec2 offset, float slack) {
  int count = int(clip_range.y >> kClipKindBits);
  if (count == 0) return false;
  vec3 place = vec3(offset, dot(offset, clip_slope));
  ivec2 nearest = ivec2(0);
  vec2 squared = vec2(uintBitsToFloat(0x7F800000u));
  for (int k = 0; k < count; ++k) {
    vec3 between = fetch_partner(k).centre.xyz - place;
    float way = dot(between, between);
    if (way < squared.x) {
      nearest = ivec2(k, nearest.x);
      squared = vec2(way, squared.x);
    } else if (way < squared.y) {
      nearest.y = k;
      squared.y = way;
    }
  }
  Partner first = fetch_partner(nearest.x);
  bool by_first = is_beyond(first.line, offset, slack);
  if (count == 1) return by_first;
  Partner second = fetch_partner(nearest.y);
  bool by_second = is_beyond(second.line, offset, slack);
  vec3 between = second.centre.xyz - first.centre.xyz;
  vec2 seen = vec2(dot(between, first.normal), -dot(between, second.normal));
  bool is_concave = all(greaterThan(seen, vec2(0.0)));
  bool is_convex = all(lessThan(seen, vec2(0.0)));
  vec2 concave = vec2(first.centre.w, second.centre.w);
  bool intersects = (is_concave && concave == vec2(0.0)) ||
                    (is_convex && concave == vec2(1.0));
  return intersects ? by_first && by_second : by_first || by_second;
}
#else
// `offset`: from the splat's centre, in cells of the base plane; `slack`: what is kept beyond lines.
bool is_clipped(vec2 offset, float slack) {
  int first = int(clip_range.x);
  int end = first + int(clip_range.y >> kClipKindBits);
  bool beyond_all = true;
  for (int k = first; k < end; ++k) {
    vec4 line = texelFetch(clip_lines, k);
    beyond_all = beyond_all && is_beyond(line, offset, slack);
    if (line.w == 0.0) continue;
    if (beyond_all) return true;
    beyond_all = true;
  }
  return false;
}
#endif
#endif
