// The shader variant that a picture of `onepass` needs.
#pragma once

#include <cstdint>

#include "renderer/features.h"

namespace relief::onepass {

/// Materials that cost more than it takes to note what is seen and to shade it later.
inline constexpr std::uint32_t kShadedMaterials =
    RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS;

[[nodiscard]] inline std::uint32_t features_of(const RenderSettings& settings, bool has_colours) {
  const std::uint32_t features = scene_features(settings, has_colours);
  const bool cells = settings.primitive == Primitive::Cell;
  return features | (cells ? RELIEF_FEATURE_CELL : 0U) |
         (cells && (features & kShadedMaterials) != 0 ? RELIEF_FEATURE_VISIBILITY : 0U) |
         (pixels_per_sample_of(settings) > 0.0 ? RELIEF_FEATURE_MASKED : 0U) |
         (settings.interpolation == Interpolation::Corrected ? RELIEF_FEATURE_CORRECTED : 0U);
}

}  // namespace relief::onepass
