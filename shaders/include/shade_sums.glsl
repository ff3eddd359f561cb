// Fragment stage of a pass over the image: normalises the sums of splats and shades, once a pixel.
#include "include/counting.glsl"
#include "include/maps.glsl"
#include "include/materials.glsl"

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;
#if RELIEF_NEEDS_NORMAL
layout(binding = RELIEF_TEXTURE_NORMAL_SUMS) uniform sampler2D normal_sums;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
layout(location = RELIEF_OUT_NORMAL) out vec4 out_normal;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(binding = RELIEF_TEXTURE_COLOUR_SUMS) uniform sampler2D colour_sums;
#endif
#if RELIEF_NEEDS_DEPTH
layout(binding = RELIEF_TEXTURE_DEPTH_SUMS) uniform sampler2D depth_sums;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
layout(location = RELIEF_OUT_DEPTH) out float out_depth;
#endif

// Sums without any weight are where the near plane cuts pass 2 off and not pass 1, which is set back.
const float kLeastSum = 1e-30;

// `material`: of the splat in front, because materials do not blend.
void shade_sums(ivec2 pixel, int material) {
  vec3 albedo = vec3(kNeutralGrey);
  vec3 normal = vec3(0.0);
  vec3 ray = vec3(0.0);
  float depth = 0.0;
#if RELIEF_NEEDS_NORMAL
  ray = normalize(ray_through(gl_FragCoord.xy));
  vec3 sum = texelFetch(normal_sums, pixel, 0).xyz;
  float squared = dot(sum, sum);
  normal = squared > 0.0 ? sum * inversesqrt(squared) : -ray;  // two that point apart cancel
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  vec4 colours = texelFetch(colour_sums, pixel, 0);
  albedo = colours.rgb / max(colours.a, kLeastSum);
#endif
#if RELIEF_NEEDS_DEPTH
  vec2 depths = texelFetch(depth_sums, pixel, 0).xy;
  depth = depths.x / max(depths.y, kLeastSum);
#endif
  out_colour = vec4(shade_material(material, albedo, normal, ray, depth), 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
  out_normal = vec4(normal, 0.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
  out_depth = depth;
#endif
}
