// Pass 3: normalises the sums and shades, once a pixel. Pass 1 covers no pixel without weight
// (discs.glsl: blending_radius).
#include "include/counting.glsl"
#include "include/maps.glsl"
#include "include/materials.glsl"

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
layout(binding = RELIEF_TEXTURE_PATCH_IDS) uniform usampler2D patch_ids;
#endif
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

void main() {
  count_fragment();
  ivec2 pixel = ivec2(gl_FragCoord.xy);
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
  albedo = colours.rgb / colours.a;
#endif
#if RELIEF_NEEDS_DEPTH
  vec2 depths = texelFetch(depth_sums, pixel, 0).xy;
  depth = depths.x / depths.y;
#endif
  int material = 0;
#if (RELIEF_FEATURES & RELIEF_FEATURE_MIXED) != 0u
  // That of the splat in front: materials do not blend.
  material = fetch_patch(texelFetch(patch_ids, pixel, 0).x - 1u).heights.w;
#endif
  out_colour = vec4(shade_material(material, albedo, normal, ray, depth), 1.0);
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL) != 0u
  out_normal = vec4(normal, 0.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH) != 0u
  out_depth = depth;
#endif
}
