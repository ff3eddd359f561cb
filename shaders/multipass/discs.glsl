// Vertex stage: how large a splat is in pass 2, and how far it is set back in pass 1.
#include "include/splats.glsl"
#include "include/sprites.glsl"

layout(location = RELIEF_UNIFORM_RADIUS_FACTOR) uniform float radius_factor;

// The radius in cells about a splat's centre that covers its parallelogram.
float covering_radius(Splat splat) {
  vec4 reach = splat.reach + splat.margin;
  vec4 x = vec4(-reach.x, reach.y, -reach.x, reach.y);
  vec4 y = vec4(-reach.zz, reach.ww);
  vec4 z = splat.slope.x * x + splat.slope.y * y;
  vec4 squared = x * x + y * y + z * z;
  return kCoveringSlack * sqrt(max(max(squared.x, squared.y), max(squared.z, squared.w)));
}

// Eq. (1) of [Ochotta 2008] times the factor, in cells. At least what covers the splat's parallelogram,
// so that no pixel that pass 1 covers is without weight; at least what reaches the next pixels
// where samples are smaller than those: the low-pass filter of Botsch et al. 2005, for discs that
// face the eye.
float blending_radius(Splat splat, PatchInfo info) {
  float of_paper = sqrt(0.5) / (0.1 + 0.9 * inversesqrt(1.0 + dot(splat.slope, splat.slope)));
  float pixel = max(splat.depth, 0.0) / (frame.ray_x.w * info.axis_u.w);
  return max(radius_factor * max(of_paper, kMinDiscPixels * pixel), covering_radius(splat));
}

// What sets the depth values of a splat in pass 1 back along the ray.
float visibility_set_back(Splat splat, PatchInfo info) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  float offset = max(kBlendingDepth * info.axis_u.w, kMinBlendingDepth * frame.ray_along.w);
  return splat.set_back + set_back_of(splat.depth, offset);
#else
  float offset = max(kBlendingDepth * info.axis_u.w, kMinBlendingDepth * splat.depth);
  float depth = max(splat.depth, offset);
  return splat.set_back * depth / (depth + offset);
#endif
}
