// The shader variant that a picture of `onepass` needs.
#pragma once

#include <cstdint>

#include "renderer/features.h"

namespace relief::onepass {

[[nodiscard]] inline std::uint32_t features_of(const RenderSettings& settings, ColourMaps colours) {
  return scene_features(settings, colours) |
         (settings.primitive == Primitive::Cell ? RELIEF_FEATURE_CELL : 0U) |
         (pixels_per_sample_of(settings) > 0.0 ? RELIEF_FEATURE_MASKED : 0U) |
         (settings.interpolation == Interpolation::Corrected ? RELIEF_FEATURE_CORRECTED : 0U);
}

}  // namespace relief::onepass
