// Pass 2: adds a surfel's attributes to the pixel's sums, weighted by the alpha texture of section
// 3.1 of [Textured surfels]; or, sorted, shades the fragment and lays it over what is there.
#include "include/counting.glsl"
#include "include/patches.glsl"
#include "surfel/layout.h"
#include "surfel/attributes.glsl"
#include "include/clipping.glsl"
#include "include/side_test.glsl"
#if RELIEF_SURFEL_IS_SORTED
#include "include/materials.glsl"
#endif
#include "include/discarding.glsl"

// Depth is not written, so that it may be tested first although fragments are discarded.
layout(early_fragment_tests) in;

layout(std140, binding = RELIEF_SURFEL_BIND_FRAME) uniform SurfelFrameBlock {
  SurfelFrame surfel_frame;
};

layout(location = 0) in vec2 disc;
#if RELIEF_SURFEL_NEEDS_NORMAL
layout(location = 1) RELIEF_SURFEL_NORMAL_IS in vec3 normal;
layout(location = RELIEF_SUM_NORMAL) out vec4 normal_sum;
#endif
#if RELIEF_SURFEL_HAS_TEXTURE
layout(location = 2) in vec2 texcoord;
layout(location = 4) flat in vec4 untextured;
layout(binding = RELIEF_SURFEL_TEXTURE_IMAGE) uniform sampler2D image;
#elif RELIEF_SURFEL_HAS_COLOUR
layout(location = 2) flat in vec3 colour;
#endif
#if RELIEF_SURFEL_NEEDS_MATERIAL
layout(location = 3) flat in int material;
#endif
#if RELIEF_SURFEL_HAS_COLOUR || RELIEF_SURFEL_IS_SORTED
layout(location = RELIEF_SUM_COLOUR) out vec4 colour_sum;
#endif
#if RELIEF_NEEDS_DEPTH
layout(location = RELIEF_SUM_DEPTH) out vec4 depth_sum;  // of which two are kept; w: of blending
#endif

void main() {
  count_fragment();
#if RELIEF_SURFEL_HAS_TEXTURE
  vec3 albedo = texture(image, texcoord).rgb;  // before any fragment is discarded
  if (untextured.w != 0.0) albedo = untextured.rgb;
#elif RELIEF_SURFEL_HAS_COLOUR
  vec3 albedo = colour;
#else
  vec3 albedo = vec3(kNeutralGrey);
#endif
  float squared = dot(disc, disc);
  RELIEF_DISCARD_IF(squared > 1.0 + kSurfelSlack || is_other_side());
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  RELIEF_DISCARD_IF(is_clipped(disc, kSurfelSlack));
#endif
  // Above 0, so that no pixel that pass 1 covers is without weight.
  float weight = max(exp2(-surfel_frame.rule.x * squared), 1e-6);
#if RELIEF_SURFEL_NEEDS_NORMAL
#if (RELIEF_FEATURES & RELIEF_FEATURE_CURVED) != 0u
  vec3 unit = normalize(normal);
#else
  vec3 unit = normal;
#endif
  normal_sum = weight * vec4(unit, 1.0);
#endif
#if RELIEF_SURFEL_IS_SORTED
#if RELIEF_SURFEL_NEEDS_NORMAL
  vec3 ray = normalize(ray_through(gl_FragCoord.xy));
#else
  vec3 ray = vec3(0.0);
  vec3 unit = vec3(0.0);
#endif
#if !RELIEF_SURFEL_NEEDS_MATERIAL
  const int material = 0;
#endif
  colour_sum =
      weight * vec4(shade_material(material, albedo, unit, ray, RELIEF_FRAGMENT_DEPTH), 1.0);
#elif RELIEF_SURFEL_HAS_COLOUR
  colour_sum = weight * vec4(albedo, 1.0);
#endif
#if RELIEF_NEEDS_DEPTH
  depth_sum = weight * vec4(RELIEF_FRAGMENT_DEPTH, 1.0, 0.0, 1.0);
#endif
  RELIEF_DISCARD_LOST;
}
