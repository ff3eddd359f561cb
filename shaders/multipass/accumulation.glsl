// Fragment stage of pass 2: adds a splat's attributes to the pixel's sums.
#include "include/counting.glsl"
#include "include/maps.glsl"
#include "include/clipping.glsl"
#include "include/side_test.glsl"

// Depth is not written, so that it may be tested first although fragments are discarded.
layout(early_fragment_tests) in;

layout(location = RELIEF_UNIFORM_RADIUS_FACTOR) uniform float radius_factor;

#if RELIEF_NEEDS_NORMAL
#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_NORMALS) == 0u
layout(location = 3) flat in vec3 splat_normal;
#endif
layout(location = RELIEF_SUM_NORMAL) out vec4 normal_sum;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_COLOURS) == 0u
layout(location = 4) flat in vec3 splat_colour;
#endif
layout(location = RELIEF_SUM_COLOUR) out vec4 colour_sum;
#endif
#if RELIEF_NEEDS_FOOTPRINT
layout(location = 5) flat in vec2 splat_position;
layout(location = 7) flat in uint splat_patch;
#endif
#if RELIEF_NEEDS_FOOTPRINT || (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
layout(location = 6) flat in vec4 splat_axes;

vec2 to_grid(vec2 in_disc) {
  return in_disc.x * splat_axes.xy + in_disc.y * splat_axes.zw;
}
#endif
#if RELIEF_NEEDS_DEPTH
layout(location = RELIEF_SUM_DEPTH) out vec2 depth_sum;
#endif

// How the position in the disc changes from pixel to pixel, to the right and upward; to be asked for
// before any fragment is discarded.
#if RELIEF_NEEDS_FOOTPRINT
#define RELIEF_DISC_FOOTPRINT(position) vec4(dFdx(position), dFdy(position))

// Fine maps are looked up at the fragment's own position on the splat: one colour or normal a splat
// would blur them.
struct PositionOnPatch {
  PatchInfo info;
  vec2 uv;
  vec4 footprint;  // grid coordinates
};

PositionOnPatch position_on_patch(vec2 position, vec4 footprint) {
  PatchInfo info = fetch_patch(splat_patch);
  return PositionOnPatch(info, clamp_to_patch(info, splat_position + to_grid(position)),
                      vec4(to_grid(footprint.xy), to_grid(footprint.zw)));
}
#else
#define RELIEF_DISC_FOOTPRINT(position) vec4(0.0)
#endif

// Whether the disc ends before a position, or its other side is seen.
bool is_off(vec2 position) {
  // In this form an undefined position is off, too.
  if (!(dot(position, position) <= 1.0)) return true;
  if (is_other_side()) return true;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  return is_clipped(to_grid(position), clip_centre.z);
#else
  return false;
#endif
}

// `position`: in the disc, of radius 1; `depth`: along the view axis.
void accumulate(vec2 position, float depth, vec4 footprint) {
  float weight = exp2(-kGaussianFall * radius_factor * dot(position, position));
#if RELIEF_NEEDS_FOOTPRINT
  PositionOnPatch on = position_on_patch(position, footprint);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_NORMALS) != 0u
  vec3 normal = to_world(on.info, look_up_normal(on.info, on.uv, on.footprint));
  normal_sum = weight * vec4(normal, 1.0);
#elif RELIEF_NEEDS_NORMAL
  normal_sum = weight * vec4(splat_normal, 1.0);
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_COLOURS) != 0u
  vec3 colour = on.info.colours.w == 0 ? vec3(kNeutralGrey)
                                       : look_up_colour(on.info, on.uv, on.footprint);
  colour_sum = weight * vec4(colour, 1.0);
#elif (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  colour_sum = weight * vec4(splat_colour, 1.0);
#endif
#if RELIEF_NEEDS_DEPTH
  depth_sum = weight * vec2(depth, 1.0);
#endif
}
