// A pixel's ray through the sheets of a regular grid, front to back. In each sheet it gathers the
// kernels whose footprints reach the pixel: their variance in sheet coordinates is that of a kernel
// seen along the ray, plus the low-pass filter's. This is the footprint of
// renderer/volume/splats/footprint.h with the Jacobian of the pixel in place of the kernel's centre.
#include "include/shared.h"
#include "volume/layout.h"
#include "volume/compositing.glsl"
#include "volume/sheets_met.glsl"

layout(std140, binding = RELIEF_VOLUME_BIND_GRID) uniform GridBlock { VolumeGrid grid; };
/// Colour and extinction, of the scales that the grid has.
layout(binding = RELIEF_VOLUME_TEXTURE_NODES) uniform sampler3D nodes;
/// Blocks from each block to the nearest one with kernels.
layout(binding = RELIEF_VOLUME_TEXTURE_DISTANCES) uniform usampler3D distances;
/// Squares of a sheet from each one to the nearest one with kernels: u, v, sheet.
layout(binding = RELIEF_VOLUME_TEXTURE_SHEET_DISTANCES) uniform usampler3D sheet_distances;
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
layout(binding = RELIEF_VOLUME_TEXTURE_NORMALS) uniform sampler3D normals;
#endif

/// A symmetric 2 x 2 matrix: xx, xy, yy.
float determinant_of(vec3 m) { return m.x * m.z - m.y * m.y; }

/// Widens the variance of a kernel (sheet coordinates) by the filter, where a ray meets a sheet.
vec3 filtered(vec3 variance, vec2 uv, float from_middle, float per_w) {
  // What a pixel is in the sheet.
  vec2 right = (grid.place_x.xy + from_middle * grid.along_x.xy - uv * grid.along_x.z) * per_w;
  vec2 up = (grid.place_y.xy + from_middle * grid.along_y.xy - uv * grid.along_y.z) * per_w;
  if (grid.camera.z != 0.0) {
    // In pixels: the inverse of the columns right and up on both sides.
    float area = right.x * up.y - right.y * up.x;
    vec2 a = vec2(up.y, -up.x);
    vec2 b = vec2(-right.y, right.x);
    vec3 pixels = vec3(a.x * a.x * variance.x + 2.0 * a.x * a.y * variance.y + a.y * a.y * variance.z,
                       0.0,
                       b.x * b.x * variance.x + 2.0 * b.x * b.y * variance.y + b.y * b.y * variance.z);
    float area2 = area * area;
    float sum = (pixels.x + pixels.z) / area2;
    float product = determinant_of(variance) / area2;
    float minor = product / (0.5 * sum + sqrt(max(0.25 * sum * sum - product, 0.0)));
    return variance * max(1.0, 1.0 / minor);
  }
  return variance + grid.kernel.w * vec3(right.x * right.x + up.x * up.x,
                                         right.x * right.y + up.x * up.y,
                                         right.y * right.y + up.y * up.y);
}

void main() {
  vec2 at = gl_FragCoord.xy - 0.5 * vec2(rule.image.xy);
  vec3 place = grid.place_origin.xyz + at.x * grid.place_x.xyz + at.y * grid.place_y.xyz;
  vec3 along = grid.along_origin.xyz + at.x * grid.along_x.xyz + at.y * grid.along_y.xyz;
  float per_w = 1.0 / along.z;
  vec2 slope = along.xy * per_w;
  vec2 ray = (at - vec2(grid.along_x.w, grid.along_y.w)) / grid.camera.xy;
  float ray_length = grid.along_origin.w != 0.0 ? 1.0 : sqrt(1.0 + dot(ray, ray));
  float step_length = ray_length * abs(per_w);  // world units from sheet to sheet
  float spread = max(1.0, max(abs(slope.x), abs(slope.y)));
  vec3 along_ray = grid.kernel.x * vec3(1.0 + slope.x * slope.x, slope.x * slope.y,
                                        1.0 + slope.y * slope.y);
  float cutoff = grid.kernel.y;
  float kept = 1.0 - exp(-0.5 * cutoff);
  float scale = grid.place_x.w * step_length / (6.283185307 * kept);
  int last = grid.w.w - 1;
  int direction = along.z < 0.0 ? -1 : 1;
  ivec2 size = ivec2(grid.u.w, grid.v.w);
  vec2 on_middle = place.xy * per_w;

  // A footprint is a convex function of the sheet: it is largest in the first or the last one.
  float far = 0.0;
  for (int end = 0; end < 2; ++end) {
    float from_middle = float(end * last) - grid.place_origin.w;
    vec3 variance = filtered(along_ray, on_middle + from_middle * slope, from_middle, per_w);
    far = max(far, sqrt(cutoff * max(variance.x, variance.z)));
  }
  // The sheets that the ray meets where there are kernels, before the eye.
  float first = grid.kernel.z * along.z - place.z;
  vec2 ends = sheets_met(on_middle, slope, far, vec2(size)) + grid.place_origin.w;
  first += grid.place_origin.w;
  if (direction > 0) ends.x = max(ends.x, first);
  else ends.y = min(ends.y, first);
  ends = clamp(ends, vec2(-1.0), vec2(float(last) + 1.0));
  int k = direction > 0 ? max(int(ceil(ends.x)), 0) : min(int(floor(ends.y)), last);
  int left = direction > 0 ? min(int(floor(ends.y)), last) - k : k - max(int(ceil(ends.x)), 0);

  float limit = limit_of_pixel();
  if (limit == -kInfinity) left = -1;
  // Of a kernel's depths: along the ray a round kernel is narrower by the ray's slope.
  float deviation = sqrt(grid.kernel.x / (1.0 + dot(slope, slope))) * abs(per_w);
  Pixel shown = empty_pixel();
  for (; left >= 0; --left, k += direction) {
    float from_middle = float(k) - grid.place_origin.w;
    vec2 uv = on_middle + from_middle * slope;
    vec3 variance = filtered(along_ray, uv, from_middle, per_w);
    vec2 reach = sqrt(cutoff * variance.xz);
    float nearest = (place.z + from_middle) * per_w - abs(per_w) * max(reach.x, reach.y);
    if (nearest - 6.0 * deviation > limit) break;

    ivec2 node = clamp(ivec2(floor(clamp(uv, vec2(-1.0), vec2(size)))), ivec2(0), size - 1);
    ivec3 block = (node.x * grid.u.xyz + node.y * grid.v.xyz + k * grid.w.xyz) / kVolumeBlock;
    float clear = float((int(texelFetch(distances, block, 0).x) - 1) * kVolumeBlock);
    clear -= max(reach.x, reach.y);
    if (clear > 0.0) {
      int steps = max(int(ceil(clear / spread)), 1) - 1;
      k += direction * steps;
      left -= steps;
      continue;
    }

    // Nothing to gather in this sheet?
    uint squares = texelFetch(sheet_distances, ivec3(node / kVolumeSheetBlock, k), 0).x;
    if (float((int(squares) - 1) * kVolumeSheetBlock) > max(reach.x, reach.y)) continue;

    float determinant = determinant_of(variance);
    vec3 shape = vec3(variance.z, -variance.y, variance.x) / determinant;
    float peak = scale * inversesqrt(determinant);
    ivec2 low = ivec2(max(ceil(uv - reach), vec2(0.0)));
    ivec2 high = ivec2(min(floor(uv + reach), vec2(size - 1)));
    float fall = exp(-shape.x);
    Layer layer = empty_layer();
    for (int j = low.y; j <= high.y; ++j) {
      vec2 d;
      d.y = uv.y - float(j);
      // The ellipse's part of the row.
      float b = shape.y * d.y;
      float half_width = sqrt(max(b * b - shape.x * (shape.z * d.y * d.y - cutoff), 0.0)) / shape.x;
      float row_middle = uv.x + b / shape.x;
      int begin = max(int(ceil(row_middle - half_width)), low.x);
      int end = min(int(floor(row_middle + half_width)), high.x);
      // exp(-q / 2) from node to node: the ratio of neighbours changes by a constant factor.
      d.x = uv.x - float(begin);
      float weight = exp(-0.5 * (shape.x * d.x * d.x + 2.0 * b * d.x + shape.z * d.y * d.y));
      float ratio = exp(shape.x * (d.x - 0.5) + b);
      ivec3 texel = begin * grid.u.xyz + j * grid.v.xyz + k * grid.w.xyz;
      for (int i = begin; i <= end; ++i) {
        vec4 found = texelFetch(nodes, texel, 0);
        vec3 normal = vec3(0.0);
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
        normal = texelFetch(normals, texel, 0).xyz;
#endif
        // The kernel's mean place on the ray.
        float off = -dot(slope, vec2(uv.x - float(i), d.y)) / (1.0 + dot(slope, slope));
        float mean = (place.z + from_middle + off) * per_w;
        float before = found.a * weight;
        if (limit < kInfinity) before = weight_before(before, mean, deviation, limit);
        add(layer, before, found.rgb, normal, mean);
        texel += grid.u.xyz;
        weight *= ratio;
        ratio *= fall;
      }
    }
    layer.depth_sum *= peak;
    layer.colour *= peak * grid.place_y.w;
    layer.normal *= peak;
    layer.place *= peak;
    if (end_layer(shown, layer)) {
      // What is behind is taken to look like what is seen.
      shown.colour /= 1.0 - shown.transmittance;
      shown.transmittance = 0.0;
      break;
    }
  }
  write_pixel(shown);
}
