// How kernels are composited: what all engines that splat them agree on.
#pragma once

#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"

namespace relief {

/// How layers are composited.
struct CompositeRule {
  KernelWeight weight = KernelWeight::Integral;
  Attenuation attenuation = Attenuation::Linear;
  double min_alpha = 0.0;           ///< of a contribution
  double max_alpha = 1.0;           ///< likewise
  double min_transmittance = 1e-6;  ///< where a pixel ends
};

[[nodiscard]] CompositeRule composite_rule(const VolumeSettings& settings, KernelWeight weight);

}  // namespace relief
