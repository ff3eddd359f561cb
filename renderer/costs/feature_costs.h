// What each feature of an image costs: the image is drawn with and without it, in turns.
#pragma once

#include <memory>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/engine.h"
#include "renderer/explanation/feature_cost.h"

namespace relief {

/// Whether features can be left out of an engine's images: it draws patches with OpenGL.
[[nodiscard]] bool can_measure_costs(const EngineEntry& engine);

/// Frames with and without each feature, by default. The median of nine is off by a third of one
/// frame's noise.
inline constexpr int kCostTurns = 9;

struct CostJob {
  const EngineEntry& engine;
  const PatchModel& patches;
  const RenderSettings& settings;        ///< of the image; `explain` is on
  std::shared_ptr<const OpenGl> opengl;  ///< current, and records
  std::shared_ptr<EnvironmentCache> environments;
  int turns = kCostTurns;
};

/// Draws the image without each feature that it uses, in turns with the whole image. Two models are
/// on the GPU at a time, and in memory where a feature is one of the model's maps. Looks between
/// frames whether the user interrupts. Fails as PreparedModel::render() does.
Result<FeatureCosts> measure_feature_costs(const CostJob& job, Progress& progress);

}  // namespace relief
