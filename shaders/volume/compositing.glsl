// Layers, composited front to back [Zwicker 2002, Eq. (7) and (10)]; as in
// renderer/engines/volume_reference/composite.cpp.
#include "include/shared.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_RULE) uniform RuleBlock { VolumeRule rule; };

layout(location = RELIEF_VOLUME_OUT_COLOUR) out vec4 out_colour;
#if RELIEF_FEATURES & (RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH)
layout(location = RELIEF_VOLUME_OUT_SURFACE) out vec4 out_surface;
#endif

/// Where opaque surfaces end what pixels show: a depth along the view axis; infinite: nowhere,
/// negative infinite: nothing is drawn.
layout(binding = RELIEF_VOLUME_TEXTURE_LIMITS) uniform sampler2D limits;

const float kInfinity = uintBitsToFloat(0x7F800000u);

float limit_of_pixel() {
  if ((rule.image.w & RELIEF_VOLUME_LIMITED) == 0u) return kInfinity;
  return texelFetch(limits, ivec2(gl_FragCoord.xy), 0).x;
}

float normal_distribution(float x) {
  // Abramowitz and Stegun 26.2.17, to 7.5e-8.
  float a = abs(x);
  float t = 1.0 / (1.0 + 0.2316419 * a);
  float tail = exp(-0.5 * a * a) * 0.3989422804 * t *
               (0.319381530 +
                t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  return x < 0.0 ? tail : 1.0 - tail;
}

/// What is left of a contribution before a finite limit (renderer/volume/share_before.h). `mean` and
/// `deviation`: of the kernel's depths.
float weight_before(float weight, float mean, float deviation, float limit) {
  float beyond = limit - mean;
  float share = deviation > 0.0 ? normal_distribution(beyond / deviation) : beyond > 0.0 ? 1.0 : 0.0;
  if ((rule.image.w & RELIEF_VOLUME_PEAK) == 0u || share <= 0.0 || share >= 1.0)
    return weight * share;
  return 1.0 - pow(1.0 - weight, share);
}

/// What the splats of a group leave in a pixel, before it is composited.
struct Layer {
  float depth_sum;  ///< optical depth, or opacity
  vec3 colour;      ///< times that
  vec3 normal;
  float place;      ///< depth along the axis, times that
};

/// What a pixel shows.
struct Pixel {
  vec3 colour;  ///< times its opacity
  float transmittance;
  vec3 normal;
  float depth;  ///< where half of what is behind is covered
};

Layer empty_layer() { return Layer(0.0, vec3(0.0), vec3(0.0), 0.0); }
Pixel empty_pixel() { return Pixel(vec3(0.0), 1.0, vec3(0.0), kInfinity); }

void add(inout Layer layer, float weight, vec3 colour, vec3 normal, float place) {
  layer.depth_sum += weight;
  layer.colour += weight * colour;
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
  layer.normal += weight * normal;
#endif
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH
  layer.place += weight * place;
#endif
}

float opacity_of(float sum) {
  bool is_exponential = (rule.image.w & RELIEF_VOLUME_EXPONENTIAL) != 0u;
  // 1 - exp(-x) loses digits of a small x: two terms are exact to 3e-6 of it there.
  float exponential = sum < 4e-3 ? sum - 0.5 * sum * sum : 1.0 - exp(-sum);
  return min(is_exponential ? exponential : sum, rule.limits.y);
}

/// Puts a layer behind what the pixel shows, and empties it. Returns whether the pixel has ended.
bool end_layer(inout Pixel shown, inout Layer layer) {
  float sum = layer.depth_sum;
  if (!(sum > 0.0)) return false;
  float alpha = opacity_of(sum);
  float after = shown.transmittance * (1.0 - alpha);
  bool ends = after < rule.limits.z;
  // As [Kerbl 2023] does: what would end a pixel is left out.
  if (ends && (rule.image.w & RELIEF_VOLUME_PEAK) != 0u) return true;
  float share = shown.transmittance * alpha / sum;
  shown.colour += share * layer.colour;
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
  shown.normal += share * layer.normal;
#endif
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH
  if (shown.transmittance > 0.5 && after <= 0.5) shown.depth = layer.place / sum;
#endif
  shown.transmittance = after;
  layer = empty_layer();
  return ends;
}

void write_pixel(Pixel shown) {
  out_colour = vec4(shown.colour, shown.transmittance);
#if RELIEF_FEATURES & (RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH)
  out_surface = vec4(shown.normal, shown.depth);
#endif
}
