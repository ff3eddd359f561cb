// The features of a scene that can be left out of it, by the names that users know them by.
#pragma once

#include <span>
#include <string_view>

#include "common/patch.h"
#include "renderer/settings.h"

namespace relief {

/// A feature, and how a scene is drawn without it.
struct RemovableFeature {
  std::string_view name;
  std::string_view instead;  ///< as FeatureCost has it
  /// Whether an image has it.
  bool (*is_used)(const RenderSettings& settings, const PatchModel& model);
  void (*leave_out)(RenderSettings& settings) = nullptr;  ///< null: the settings stay
  void (*leave_out_of)(PatchModel& patches) = nullptr;    ///< null: the model stays
};

/// All of them, in the order of reports. What one needs alone goes with it: normals with light,
/// fine normals with normals.
[[nodiscard]] std::span<const RemovableFeature> removable_features();

}  // namespace relief
