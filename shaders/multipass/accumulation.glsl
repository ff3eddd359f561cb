// Fragment stage of pass 2: adds a splat's attributes to the pixel's sums.
#include "include/counting.glsl"
#include "include/maps.glsl"

// Depth is not written, so that it may be tested first although fragments are discarded.
layout(early_fragment_tests) in;

layout(location = RELIEF_UNIFORM_RADIUS_FACTOR) uniform float radius_factor;

#if RELIEF_NEEDS_NORMAL
layout(location = 3) flat in vec3 splat_normal;
layout(location = RELIEF_SUM_NORMAL) out vec4 normal_sum;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(location = 4) flat in vec3 splat_colour;
layout(location = RELIEF_SUM_COLOUR) out vec4 colour_sum;
#endif
#if RELIEF_NEEDS_DEPTH
layout(location = RELIEF_SUM_DEPTH) out vec2 depth_sum;
#endif

// `place`: in the disc, of radius 1; `depth`: along the view axis.
void accumulate(vec2 place, float depth) {
  float weight = exp2(-kGaussianFall * radius_factor * dot(place, place));
#if RELIEF_NEEDS_NORMAL
  normal_sum = weight * vec4(splat_normal, 1.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  colour_sum = weight * vec4(splat_colour, 1.0);
#endif
#if RELIEF_NEEDS_DEPTH
  depth_sum = weight * vec2(depth, 1.0);
#endif
}
