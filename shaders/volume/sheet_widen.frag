// Widens the kernels of a sheet along u, then along v: together to what is left of a footprint when
// the sheet is read (grid_sheets.frag). V = (a along u) + (b along (t, 1)), so that the second pass
// goes along a slanted line where a footprint does.
#include "volume/sheets.glsl"

layout(binding = RELIEF_VOLUME_TEXTURE_SHEETS) uniform sampler2D texels;
layout(location = RELIEF_VOLUME_UNIFORM_AXIS) uniform int axis;

flat in ivec3 origin;

layout(location = 0) out vec4 out_node;

/// xx, xy, yy of the footprint of a node, as the ray through it sees it.
vec3 variance_at(vec2 uv, float w) {
  vec3 along = sheets.eye.xyz;
  if (sheets.eye.w == 0.0)
    along = (vec3(uv, w) - along) / (sheets.depth.w + dot(sheets.depth.xyz, vec3(uv, w)));
  float per_w = 1.0 / along.z;
  vec2 slope = along.xy * per_w;
  float from_middle = w - grid.place_origin.w;
  vec2 right = (grid.place_x.xy + from_middle * grid.along_x.xy - uv * grid.along_x.z) * per_w;
  vec2 up = (grid.place_y.xy + from_middle * grid.along_y.xy - uv * grid.along_y.z) * per_w;
  vec3 kernel = grid.kernel.x * vec3(1.0 + slope.x * slope.x, slope.x * slope.y,
                                     1.0 + slope.y * slope.y);
  vec3 filtered = kernel + grid.kernel.w * vec3(right.x * right.x + up.x * up.x,
                                                right.x * right.y + up.x * up.y,
                                                right.y * right.y + up.y * up.y);
  return sheets.kernel.x * filtered - sheets.kernel.y * vec3(1.0, 0.0, 1.0);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 variance = variance_at(vec2(at - origin.xy), float(origin.z));
  float slant = variance.y / variance.z;
  float along_v = variance.z;
  int reach = int(sheets.kernel.z);
  // exp(-d^2 / 2v) for whole d, as products.
  if (axis == 0) {
    // What the second pass reads between two texels is widened by that.
    float between = 0.0;
    float all = 1.0;
    for (int d = 1; d <= reach; ++d) {
      float share = fract(slant * float(d));
      float of_tap = 2.0 * exp(-0.5 * float(d * d) / along_v);
      between += of_tap * share * (1.0 - share);
      all += of_tap;
    }
    float along_u = max(variance.x - slant * variance.y - between / all, 0.02);
    float power = exp(-0.5 / along_u);
    float weight = 1.0;
    float ratio = power;
    float sum = 1.0;
    vec4 node = texelFetch(texels, at, 0);
    for (int d = 1; d <= reach; ++d) {
      weight *= ratio;
      ratio *= power * power;
      node += weight * (texelFetch(texels, ivec2(at.x - d, at.y), 0) + texelFetch(texels, ivec2(at.x + d, at.y), 0));
      sum += 2.0 * weight;
    }
    out_node = node / sum;
  } else {
    float power = exp(-0.5 / along_v);
    float weight = 1.0;
    float ratio = power;
    float sum = 1.0;
    vec4 node = texelFetch(texels, at, 0);
    float off = 0.0;
    for (int d = 1; d <= reach; ++d) {
      weight *= ratio;
      ratio *= power * power;
      off += slant;
      int low = int(floor(off));
      float share = off - float(low);
      vec4 above = mix(texelFetch(texels, ivec2(at.x + low, at.y + d), 0), texelFetch(texels, ivec2(at.x + low + 1, at.y + d), 0), share);
      vec4 below = mix(texelFetch(texels, ivec2(at.x - low, at.y - d), 0), texelFetch(texels, ivec2(at.x - low - 1, at.y - d), 0), share);
      node += weight * (above + below);
      sum += 2.0 * weight;
    }
    out_node = node / sum;
  }
}
