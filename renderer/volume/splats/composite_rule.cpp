#include "renderer/volume/splats/composite_rule.h"

namespace relief {

CompositeRule composite_rule(const VolumeSettings& settings, KernelWeight weight) {
  CompositeRule rule;
  rule.weight = weight;
  rule.attenuation = settings.attenuation;
  if (weight == KernelWeight::Peak) {
    rule.min_alpha = settings.gaussians.min_alpha;
    rule.max_alpha = settings.gaussians.max_alpha;
    rule.min_transmittance = settings.gaussians.min_transmittance;
  }
  return rule;
}

}  // namespace relief
