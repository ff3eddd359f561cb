// Fragment stage of pass 2 over splats: whether a splat shows another side than the one in front.
#if (RELIEF_FEATURES & RELIEF_FEATURE_SIDED) != 0u
layout(location = 12) flat in uint side;
layout(binding = RELIEF_TEXTURE_SIDES) uniform usampler2D sides;

bool is_other_side() {
  return texelFetch(sides, ivec2(gl_FragCoord.xy), 0).x != side;
}
#else
bool is_other_side() {
  return false;
}
#endif
