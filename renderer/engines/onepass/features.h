// The shader variant that an image of `onepass` needs.
#pragma once

#include <cstdint>

#include "renderer/frame/features.h"
#include "renderer/shading/materials.h"

namespace relief::onepass {

/// Materials that cost more than it takes to note what is seen and to shade it later.
inline constexpr std::uint32_t kShadedMaterials =
    RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS;

inline constexpr std::uint32_t kFineFeatures =
    RELIEF_FEATURE_FINE_COLOURS | RELIEF_FEATURE_FINE_NORMALS;

[[nodiscard]] inline Features features_of(const RenderSettings& settings, ModelMaps maps) {
  const Features features = scene_features(settings, maps) |
                            (has_two_interfaces(settings) ? RELIEF_FEATURE_TWO_INTERFACES : 0U);
  const bool cells = settings.primitive == Primitive::Cell;
  // A fine map is averaged over a pixel's footprint, which what was found does not tell.
  const bool later = is_transparent(settings) || has_two_interfaces(settings) ||
                     (features.has(kShadedMaterials) && !features.has(kFineFeatures));
  return features | (cells ? RELIEF_FEATURE_CELL : 0U) |
         (cells && later ? RELIEF_FEATURE_VISIBILITY : 0U) |
         (pixels_per_sample_of(settings) > 0.0 ? RELIEF_FEATURE_MASKED : 0U) |
         (settings.interpolation == Interpolation::Corrected ? RELIEF_FEATURE_CORRECTED : 0U);
}

}  // namespace relief::onepass
