// Vertex stage: from a sample record to its splat.
#include "include/patches.glsl"

layout(binding = RELIEF_TEXTURE_SAMPLES) uniform usamplerBuffer sample_records;

// A splat in the grid frame of its patch.
struct Splat {
  vec3 centre;
  vec2 slope;        // of its tangent plane: height per cell
  float half_width;  // of the square of the base plane over which it extends, in cells
  float depth;       // of its centre, along the view axis, in world units
  float set_back;    // factor on its depth value: below 1 for border splats
};

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
  splat.set_back = border ? splat.depth / (splat.depth + kBorderSetBack * spacing) : 1.0;
  return splat;
}

// Corner 0 to 3 of the parallelogram in the splat's tangent plane over its square.
vec3 splat_corner(Splat splat, int corner) {
  vec2 side = vec2(corner & 1, (corner >> 1) & 1) * 2.0 - 1.0;
  vec2 offset = side * splat.half_width;
  return splat.centre + vec3(offset, dot(offset, splat.slope));
}

// Radius of the splat's disc in cells: Eq. (1) of paper 001, raised to what covers its square.
// Eq. (1) alone leaves holes in the middle of cells that lean toward a grid diagonal: there the
// disc must reach sqrt(1/2) / cos, and 1 / (0.1 + 0.9 cos) is less.
float splat_radius(Splat splat) {
  float cosine = inversesqrt(1.0 + dot(splat.slope, splat.slope));
  float of_paper = sqrt(0.5) / (0.1 + 0.9 * cosine);
  return max(of_paper, sqrt(2.0) * splat.half_width / cosine);
}
