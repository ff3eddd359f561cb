// Vertex stage: from a sample record to its splat.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_SAMPLES) uniform usamplerBuffer sample_records;
layout(binding = RELIEF_TEXTURE_HEIGHTS) uniform usampler2DArray height_maps;

// A splat in the grid frame of its patch.
struct Splat {
  vec3 centre;
  vec2 slope;        // of its tangent plane: height per cell
  float half_width;  // of the square of the base plane over which it extends, in cells
  vec4 reach;        // how far it extends toward -x, +x, -y, +y: half_width, or less (see trim)
  float depth;       // of its centre, along the view axis, in world units
  float set_back;    // factor on its depth value: below 1 for border splats
};

bool is_hole(ivec2 node, PatchInfo info) {
  if (any(lessThan(node, ivec2(0))) || any(greaterThanEqual(node, info.nodes.xy))) return true;
  return texelFetch(height_maps, ivec3(info.heights.xy + node, info.heights.z), 0).x == kHoleTexel;
}

// How far a border splat extends: toward a neighbour as others do; toward a hole half a spacing along
// its slope. Half a cell of the base plane there would be a spike in the air where the slope is steep.
vec4 trim(ivec2 node, vec2 slope, float half_width, PatchInfo info) {
  vec2 outward = min(inversesqrt(1.0 + slope * slope), 0.5);
  vec4 reach = vec4(half_width);
  if (is_hole(node - ivec2(1, 0), info)) reach.x = outward.x;
  if (is_hole(node + ivec2(1, 0), info)) reach.y = outward.x;
  if (is_hole(node - ivec2(0, 1), info)) reach.z = outward.y;
  if (is_hole(node + ivec2(0, 1), info)) reach.w = outward.y;
  return reach;
}

Splat fetch_splat(int record, PatchInfo info, mat4 clip_from_grid) {
  uvec2 bits = texelFetch(sample_records, record).xy;
  float spacing = info.axis_u.w;
  float height_step = info.axis_v.w;
  float slope_step = info.axis_n.w;

  Splat splat;
  splat.centre = vec3(bits.x & kNodeMask, (bits.x >> kRowShift) & kNodeMask,
                      float(bits.y & 0xFFFFu) * height_step);
  splat.slope = slope_step * vec2(bitfieldExtract(int(bits.y), 16, 8),
                                  bitfieldExtract(int(bits.y), 24, 8));
  splat.depth = dot(vec4(clip_from_grid[0].w, clip_from_grid[1].w, clip_from_grid[2].w,
                         clip_from_grid[3].w), vec4(splat.centre, 1.0));
  float pixel = max(splat.depth, 0.0) / (frame.ray_x.w * spacing);  // in cells
  splat.half_width = 0.5 + max(kMargins[(bits.x >> kClassShift) & kClassMask],
                               kMarginPixels * pixel);
  bool border = (bits.x & kBorderBit) != 0u && splat.depth > 0.0;
  splat.reach = (bits.x & kBorderBit) != 0u
                    ? trim(ivec2(splat.centre.xy), splat.slope, splat.half_width, info)
                    : vec4(splat.half_width);
  float behind = kBorderSetBack * spacing * sqrt(1.0 + dot(splat.slope, splat.slope));
  splat.set_back = border ? splat.depth / (splat.depth + behind) : 1.0;
  return splat;
}

// Corner 0 to 3 of the parallelogram in the splat's tangent plane over its part of the base plane.
vec3 splat_corner(Splat splat, int corner) {
  vec2 offset = vec2((corner & 1) == 0 ? -splat.reach.x : splat.reach.y,
                     (corner & 2) == 0 ? -splat.reach.z : splat.reach.w);
  return splat.centre + vec3(offset, dot(offset, splat.slope));
}

// Radius of the splat's disc in cells: Eq. (1) of paper 001, or what covers the plane if that is
// more. Nodes of a plane that leans by an angle of cosine c along a grid axis form rectangles of
// 1 by 1/c, whose corners a disc of half their diagonal, sqrt(1 + 1/c^2) / 2, just reaches; leaning
// any other way needs less. Eq. (1) reaches that for c from 0.21 to 1, at both ends with nothing to
// spare; the splat's margin is added to it here.
float splat_radius(Splat splat) {
  float steepness = dot(splat.slope, splat.slope);  // 1/c^2 - 1
  float of_paper = sqrt(0.5) / (0.1 + 0.9 * inversesqrt(1.0 + steepness));
  return max(of_paper, splat.half_width * sqrt(2.0 + steepness));
}
