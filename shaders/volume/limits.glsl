// The rule of an image, and what it makes of contributions: opacities, and where opaque surfaces
// end them.
#include "include/shared.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_RULE) uniform RuleBlock { VolumeRule rule; };

/// Where opaque surfaces end what pixels show: a depth along the view axis; infinite: nowhere,
/// negative infinite: nothing is drawn.
layout(binding = RELIEF_VOLUME_TEXTURE_LIMITS) uniform sampler2D limits;

const float kInfinity = uintBitsToFloat(0x7F800000u);

float limit_of_pixel() {
  if ((rule.image.w & RELIEF_VOLUME_LIMITED) == 0u) return kInfinity;
  return texelFetch(limits, ivec2(gl_FragCoord.xy), 0).x;
}

/// Opacity of an optical depth by the rule's attenuation.
float opacity_of(float depth) {
  bool is_exponential = (rule.image.w & RELIEF_VOLUME_EXPONENTIAL) != 0u;
  // 1 - exp(-x) loses digits of a small x: two terms are exact to 3e-6 of it there.
  float exponential = depth < 4e-3 ? depth - 0.5 * depth * depth : 1.0 - exp(-depth);
  return min(is_exponential ? exponential : depth, rule.limits.y);
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

/// What is left of a contribution before a finite limit (renderer/volume/splats/share_before.h). `mean` and
/// `deviation`: of the kernel's depths.
float weight_before(float weight, float mean, float deviation, float limit) {
  float beyond = limit - mean;
  float share = deviation > 0.0 ? normal_distribution(beyond / deviation) : beyond > 0.0 ? 1.0 : 0.0;
  if ((rule.image.w & RELIEF_VOLUME_PEAK) == 0u || share <= 0.0 || share >= 1.0)
    return weight * share;
  return 1.0 - pow(1.0 - weight, share);
}
