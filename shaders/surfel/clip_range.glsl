// Vertex stage: which lines clip a surfel. Their frame is the disc of radius 1 (clipping.glsl).
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
layout(binding = RELIEF_TEXTURE_CLIP_RANGES) uniform usamplerBuffer clip_ranges;

layout(location = 8) flat out uvec2 clip_range;
layout(location = 9) flat out vec3 clip_centre;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIP_WICKE) != 0u
layout(location = 10) flat out vec2 clip_slope;
#endif

void write_clip_range(int number) {
  clip_range = texelFetch(clip_ranges, number).xy;
  clip_centre = vec3(0.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIP_WICKE) != 0u
  clip_slope = vec2(0.0);
#endif
}
#else
void write_clip_range(int number) {}
#endif
