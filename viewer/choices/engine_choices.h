// The engines that a user can pick, and what picking one does to a look.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "renderer/engine_registry.h"

namespace relief {

/// Samples a pixel that a window offers: its bands of 16 rows then take less than a second on one
/// core, and a picture of more is `relief render`'s.
inline constexpr int kMostSamples = 64;

/// Returns the engines that draw this model into a window.
[[nodiscard]] std::vector<const EngineEntry*> engines_for(const RenderModel& model);

/// Gives a look an engine, without the values and materials that the engine has not.
void choose_engine(SceneSettings& look, const EngineEntry& engine);

/// Gives a look a value of an option, without the materials that the engine then has not.
void choose_value(SceneSettings& look, const EngineEntry& engine, const std::string& key,
                  const OptionValue& value);

/// Returns the range that a window offers of a numeric option.
[[nodiscard]] NumberChoice offered_range(const OptionRow& row);

/// Returns the samples a pixel of square grids, the fewest first, up to kMostSamples.
[[nodiscard]] std::vector<int> offered_samples();

/// Returns a key as a label: "pixels-per-sample" is "Pixels per sample".
[[nodiscard]] std::string label_of(std::string_view key);

}  // namespace relief
