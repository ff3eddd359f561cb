// Vertex stage: from a sample record to its splat.
#include "include/heights.glsl"

#if (RELIEF_FEATURES & RELIEF_FEATURE_CELL) != 0u
layout(binding = RELIEF_TEXTURE_RIMS) uniform usamplerBuffer rims;

layout(location = RELIEF_ATTRIBUTE_CORNER) in uint part_corner;
#else
layout(binding = RELIEF_TEXTURE_SAMPLES) uniform usamplerBuffer sample_records;
#endif

// A splat in the grid frame of its patch.
struct Splat {
  vec3 centre;
  vec2 slope;        // of its tangent plane: height per cell
  vec4 reach;        // how far it extends over the base plane toward -x, +x, -y, +y, in cells
  vec4 margin;       // and beyond that to close gaps
  float depth;       // of its centre, along the view axis, in world units; orthographic: 1
  float set_back;    // of its depth values (projection.glsl): those of border splats are
};

// The margins beyond a splat's reaches that close its gaps (cells high) for the view ray to its
// centre, in cells of the base plane (renderer/splat_reach.h).
vec4 margins_of(vec4 gaps, vec2 slope, vec3 ray) {
  float way = length(ray.xy);
  float approach = max(abs(ray.z - dot(slope, ray.xy)), kLowestView * way);
  float largest = kLargestMargin * inversesqrt(1.0 + dot(slope, slope));
  return approach > 0.0 ? min(0.5 * gaps * way / approach, largest) : vec4(0.0);
}

// Four words as shared.h says; those of a rim, which has no gaps and whose height is kept with the
// cells', from its two.
uvec4 fetch_record(int record, PatchInfo info) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_CELL) != 0u
  uvec2 rim = texelFetch(rims, record).xy;
  uvec2 node = uvec2(part_corner & 0xFFFFu, part_corner >> 16) +
               uvec2(rim.x & kNodeInPartMask, (rim.x >> kNodeInPartBits) & kNodeInPartMask);
  uint shape = fetch_height(info, ivec2(node)) | (rim.x & 0xFFFF0000u);
  return uvec4(node.x | node.y << kRowShift | kBorderBit, shape, rim.y, 0u);
#else
  return texelFetch(sample_records, record);
#endif
}

Splat fetch_splat(int record, PatchInfo info, mat4 clip_from_grid, vec4 eye) {
  uvec4 bits = fetch_record(record, info);
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
  vec4 gaps = kGapStep * 255.0 * unpackUnorm4x8(bits.w);
  splat.reach = kReachStep * 255.0 * unpackUnorm4x8(bits.z) + kMarginPixels * pixel;
  splat.margin = margins_of(gaps, splat.slope, ray_toward(splat.centre, eye));
  bool border = (bits.x & kBorderBit) != 0u && splat.depth > 0.0;
  float behind = kBorderSetBack * spacing * sqrt(1.0 + dot(splat.slope, splat.slope));
  splat.set_back = border ? set_back_of(splat.depth, behind) : kNotSetBack;
  return splat;
}

// The ray toward a splat's centre along the normal of its plane; of any length.
float facing_along(Splat splat, vec4 eye) {
  vec3 ray = ray_toward(splat.centre, eye);
  return ray.z - dot(splat.slope, ray.xy);
}

#if (RELIEF_FEATURES & RELIEF_FEATURE_FRONT) != 0u
layout(location = RELIEF_UNIFORM_FRONT) uniform bool front_alone;

// Whether it is not drawn because its plane faces away from the eye.
bool is_hidden_back(Splat splat, vec4 eye) {
  return front_alone && facing_along(splat, eye) >= 0.0;
}
#endif

// Corner 0 to 3 of the parallelogram in the splat's tangent plane over what lies within `reach` of
// its centre.
vec3 splat_corner(Splat splat, vec4 reach, int corner) {
  vec2 offset = vec2((corner & 1) == 0 ? -reach.x : reach.y,
                     (corner & 2) == 0 ? -reach.z : reach.w);
  return splat.centre + vec3(offset, dot(offset, splat.slope));
}

// Radius of the splat's disc in cells: Eq. (1) of [Ochotta 2008], or what covers the splat's parallelogram
// if that is more. Nodes of a plane that leans by an angle of cosine c along a grid axis form
// rectangles of 1 by 1/c, whose corners a disc of half their diagonal, sqrt(1 + 1/c^2) / 2, just
// reaches; leaning any other way needs less. Eq. (1) reaches that for c from 0.21 to 1, at both ends
// with nothing to spare. Margins count along one axis at a time.
float splat_radius(Splat splat) {
  float steepness = dot(splat.slope, splat.slope);  // 1/c^2 - 1
  float of_paper = sqrt(0.5) / (0.1 + 0.9 * inversesqrt(1.0 + steepness));
  float squared = of_paper * of_paper;
  vec4 along_x = splat.reach + vec4(splat.margin.xy, 0.0, 0.0);
  vec4 along_y = splat.reach + vec4(0.0, 0.0, splat.margin.zw);
  for (int corner = 0; corner < 4; ++corner) {
    vec3 to_x = splat_corner(splat, along_x, corner) - splat.centre;
    vec3 to_y = splat_corner(splat, along_y, corner) - splat.centre;
    squared = max(squared, max(dot(to_x, to_x), dot(to_y, to_y)));
  }
  return sqrt(squared);
}

// Where a disc ends over the base plane before its radius does, toward -x, +x, -y, +y: at the crest
// where the next splat's plane, or a hole, is nearer than half a cell.
vec4 disc_limits(Splat splat) {
  return mix(splat.reach + splat.margin, vec4(1e9), greaterThanEqual(splat.reach, vec4(0.5)));
}
