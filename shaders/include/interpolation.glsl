// Attribute interpolation, section 3.5 of paper 001.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_HEIGHTS) uniform usampler2DArray height_maps;

// Moves `hit`, where the view ray along `ray` meets the splat (both in the grid frame), to where
// the ray meets the plane through the elevated corners of the virtual triangle under it. Returns
// how far along the ray that is, in lengths of `ray`; 0, and `hit` unchanged, where a corner is a
// hole. All cells are halved along the diagonal from (0, 0) to (1, 1).
float correct(inout vec3 hit, vec3 ray, PatchInfo info) {
  ivec2 cell = clamp(ivec2(floor(hit.xy)), ivec2(0), max(info.nodes.xy - 2, ivec2(0)));
  vec2 inside = hit.xy - vec2(cell);
  bool lower = inside.x > inside.y;
  ivec3 at = ivec3(info.heights.xy + cell, info.heights.z);
  uint a = texelFetch(height_maps, at, 0).x;
  uint b = texelFetch(height_maps, at + (lower ? ivec3(1, 0, 0) : ivec3(0, 1, 0)), 0).x;
  uint c = texelFetch(height_maps, at + ivec3(1, 1, 0), 0).x;
  if (a == kHoleTexel || b == kHoleTexel || c == kHoleTexel) return 0.0;

  float height_step = info.axis_v.w;
  float ab = (float(b) - float(a)) * height_step;
  float bc = (float(c) - float(b)) * height_step;
  vec2 slope = lower ? vec2(ab, bc) : vec2(bc, ab);
  float above = hit.z - (float(a) * height_step + dot(slope, inside));
  float descent = dot(slope, ray.xy) - ray.z;  // toward the plane, per length of ray
  float along = above / descent;
  float limit = kLargestCorrection * inversesqrt(max(dot(ray.xy, ray.xy), 1e-30));
  // A ray within the plane gives 0 / 0 or an infinity.
  along = descent == 0.0 ? 0.0 : clamp(along, -limit, limit);
  hit += along * ray;
  return along;
}
