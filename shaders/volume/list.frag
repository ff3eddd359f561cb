// A pixel's splats one after the other, front to back, from its tile's list: what
// renderer/engines/volume_reference/composite.cpp does.
#include "include/shared.h"
#include "volume/layout.h"
#include "volume/compositing.glsl"

layout(binding = RELIEF_VOLUME_TEXTURE_SPLATS) uniform samplerBuffer splats;
/// A splat, and its group times 2, plus 1 if it is the tile's last of that group.
layout(binding = RELIEF_VOLUME_TEXTURE_ENTRIES) uniform usamplerBuffer entries;
layout(binding = RELIEF_VOLUME_TEXTURE_STARTS) uniform usamplerBuffer starts;

/// The share of a kernel with that mean depth and deviation that lies in a slab and before `limit`.
float share_in_slab(float mean, float deviation, uint slab, float limit) {
  float low = rule.slabs.x + rule.slabs.y * float(slab) - mean;
  float high = min(low + rule.slabs.y, limit - mean);
  if (high <= low) return 0.0;
  if (!(deviation > 0.0)) return low <= 0.0 && high > 0.0 ? 1.0 : 0.0;
  return normal_distribution(high / deviation) - normal_distribution(low / deviation);
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  uint tile = (rule.image.y - 1u - pixel.y) / uint(kVolumeTile) * rule.image.z +
              pixel.x / uint(kVolumeTile);
  int end = int(texelFetch(starts, int(tile) + 1).x);
  bool is_peak = (rule.image.w & RELIEF_VOLUME_PEAK) != 0u;
  bool has_slabs = (rule.image.w & RELIEF_VOLUME_SLABS) != 0u;
  float limit = limit_of_pixel();
  if (limit == -kInfinity) end = 0;
  Pixel shown = empty_pixel();
  Layer layer = empty_layer();
  for (int e = int(texelFetch(starts, int(tile)).x); e < end; ++e) {
    uvec2 entry = texelFetch(entries, e).xy;
    int at = int(entry.x) * kVolumeSplatRows;
    vec4 place = texelFetch(splats, at);
    vec4 shape = texelFetch(splats, at + 1);
    vec2 d = gl_FragCoord.xy - place.xy;
    float q = shape.x * d.x * d.x + 2.0 * shape.y * d.x * d.y + shape.z * d.y * d.y;
    if (q < place.z) {
      float weight = place.w * exp(-0.5 * q);
      if (is_peak) {
        weight = min(weight, rule.limits.y);
        if (weight < rule.limits.x) weight = 0.0;
      }
      vec4 colour = texelFetch(splats, at + 2);
      float depth = shape.w;
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH
      depth += dot(texelFetch(splats, at + 4).xy, d);
#endif
      if (has_slabs || limit < kInfinity) {
        float mean = shape.w + dot(texelFetch(splats, at + 4).xy, d);
        weight = has_slabs ? weight * share_in_slab(mean, colour.w, entry.y >> 1, limit)
                           : weight_before(weight, mean, colour.w, limit);
      }
      vec3 normal = vec3(0.0);
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
      normal = texelFetch(splats, at + 3).xyz;
#endif
      add(layer, weight, colour.rgb, normal, depth);
    }
    if ((entry.y & 1u) != 0u && end_layer(shown, layer)) break;
  }
  write_pixel(shown);
}
