// The plan for a file that the user names: its models, and their views with settings.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/scene/camera.h"
#include "common/scene/scene.h"
#include "renderer/engine_registry.h"

namespace relief {

/// A view to draw.
struct PlannedView {
  std::string name;  ///< in the scene file; empty without one
  /// The overrides, over the view's settings, over the scene's.
  SceneSettings settings;
  /// By material number, if some model names a material of its own: the overrides, over the
  /// model's material, over the view's and the scene's; in the order of distinct_materials().
  std::vector<MaterialSettings> materials;
  /// By model, if some model names options of its own: the overrides, over the model's, over the
  /// view's and the scene's.
  std::vector<OptionValues> options_of_models = {};
};

struct ScenePlan {
  std::filesystem::path file;  ///< the scene file; empty without one
  std::vector<SceneModel> models;
  std::vector<PlannedView> views;
  /// Above 0: the only view is a film of so many frames, in which the camera goes once around, or
  /// is that of each frame.
  std::size_t film_frames = 0;
  std::vector<Camera> film_cameras;  ///< empty, or as many as there are frames
};

/// Reads a scene (.json). Any other file is a scene of one model and one view. `overrides` win over
/// the settings of the scene and its views. Opens no file but the scene. Fails as read_scene does,
/// and if the materials of a view have more than kMaxRoughnesses roughnesses. `among`: the engines
/// that the scene can name.
Result<ScenePlan> plan_scene(const std::filesystem::path& input, const SceneSettings& overrides,
                             std::span<const EngineEntry> among = engines());

/// Returns the engines' names and options for reading scene files.
[[nodiscard]] EngineKeys engine_keys(std::span<const EngineEntry> among = engines());

/// The files that the plan reads: the scene file, models and environments, each once. Fails if one
/// is missing, so that it is known before any long work.
Result<std::vector<std::filesystem::path>> find_inputs(const ScenePlan& plan);

}  // namespace relief
