// A pixel's ray through prefiltered sheets, front to back: each is read where the ray meets it.
#include "volume/sheets.glsl"
#include "volume/compositing.glsl"
#include "volume/sheets_met.glsl"

/// Blocks from each block to the nearest one with kernels.
layout(binding = RELIEF_VOLUME_TEXTURE_DISTANCES) uniform usampler3D distances;
layout(binding = RELIEF_VOLUME_TEXTURE_SHEETS) uniform sampler2D texels;

void main() {
  vec2 at = gl_FragCoord.xy - 0.5 * vec2(rule.image.xy);
  vec3 place = grid.place_origin.xyz + at.x * grid.place_x.xyz + at.y * grid.place_y.xyz;
  vec3 along = grid.along_origin.xyz + at.x * grid.along_x.xyz + at.y * grid.along_y.xyz;
  float per_w = 1.0 / along.z;
  vec2 slope = along.xy * per_w;
  vec2 ray = (at - vec2(grid.along_x.w, grid.along_y.w)) / grid.camera.xy;
  float ray_length = grid.along_origin.w != 0.0 ? 1.0 : sqrt(1.0 + dot(ray, ray));
  float scale = grid.place_x.w * ray_length * abs(per_w);
  float spread = max(1.0, max(abs(slope.x), abs(slope.y)));
  int last = grid.w.w - 1;
  int direction = along.z < 0.0 ? -1 : 1;
  vec2 size = vec2(grid.u.w, grid.v.w);
  float reach = sheets.kernel.z + 1.0;
  vec2 on_middle = place.xy * per_w;
  // The sheets that the ray meets where there are kernels, before the eye.
  float first = grid.kernel.z * along.z - place.z;
  vec2 ends = sheets_met(on_middle, slope, reach, size);
  ends += grid.place_origin.w;
  first += grid.place_origin.w;
  if (direction > 0) ends.x = max(ends.x, first); else ends.y = min(ends.y, first);
  ends = clamp(ends, vec2(-1.0), vec2(float(last) + 1.0));
  int k = direction > 0 ? max(int(ceil(ends.x)), 0) : min(int(floor(ends.y)), last);
  int steps_left = direction > 0 ? min(int(floor(ends.y)), last) - k : k - max(int(ceil(ends.x)), 0);
  vec2 per_texel = 1.0 / vec2(textureSize(texels, 0));

  Pixel shown = empty_pixel();
  while (steps_left >= 0) {
    vec2 uv = on_middle + (float(k) - grid.place_origin.w) * slope;
    ivec2 node = ivec2(clamp(uv, vec2(0.0), size - 1.0));
    ivec3 block = (node.x * grid.u.xyz + node.y * grid.v.xyz + k * grid.w.xyz) / kVolumeBlock;
    float clear = float((int(texelFetch(distances, block, 0).x) - 1) * kVolumeBlock) - reach;
    if (clear > 0.0) {
      int steps = max(int(ceil(clear / spread)), 1);
      k += direction * steps;
      steps_left -= steps;
      continue;
    }
    vec4 found = textureLod(texels, (vec2(origin_of_sheet(k)) + uv + 0.5) * per_texel, 0.0);
    Layer layer = Layer(found.a * scale, found.rgb * scale, vec3(0.0), 0.0);
    if (end_layer(shown, layer)) break;
    k += direction;
    --steps_left;
  }
  write_pixel(shown);
}
