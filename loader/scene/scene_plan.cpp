#include "loader/scene/scene_plan.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "common/io/extension.h"
#include "common/io/standard_input.h"
#include "renderer/shading/environment/environment_files.h"
#include "renderer/shading/materials.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// The materials of a view of a scene; none if the models name none.
std::vector<MaterialSettings> materials_for(const std::vector<MaterialOverrides>& of_models,
                                            const MaterialOverrides& of_view,
                                            const MaterialOverrides& overrides) {
  std::vector<MaterialSettings> materials;
  if (of_models == std::vector<MaterialOverrides>(1)) return materials;
  for (const MaterialOverrides& own : of_models)
    materials.push_back(material_of(overlay_material(overlay_material(of_view, own), overrides)));
  return materials;
}

/// The options of each model in a view of a scene; none if the models name none.
std::vector<OptionValues> options_for(const std::vector<SceneModel>& models,
                                      const OptionValues& of_view, const OptionValues& overrides) {
  std::vector<OptionValues> options;
  if (std::all_of(models.begin(), models.end(),
                  [](const SceneModel& model) { return model.options.empty(); }))
    return options;
  for (const SceneModel& model : models)
    options.push_back(overlay_options(overlay_options(of_view, model.options), overrides));
  return options;
}

}  // namespace

EngineKeys engine_keys(std::span<const EngineEntry> among) {
  EngineKeys keys;
  for (const EngineEntry& engine : among) keys.engines.push_back(engine.name);
  for (SharedOption& option : shared_options(among)) keys.options.push_back(std::move(option.row));
  return keys;
}

Result<ScenePlan> plan_scene(const fs::path& input, const SceneSettings& overrides,
                             std::span<const EngineEntry> among) {
  ScenePlan plan;
  if (lower_extension(input) != ".json") {
    plan.models.push_back({.file = input});
    plan.views.push_back({"", overrides, {}, {}});
    return plan;
  }
  RELIEF_TRY_ASSIGN(auto scene, read_scene(input, engine_keys(among)));
  plan.file = input;
  plan.models = std::move(scene.models);
  const std::vector<MaterialOverrides> of_models = distinct_materials(plan.models);
  for (const SceneView& view : scene.views) {
    const SceneSettings of_view = overlay(scene.settings, view.settings);
    plan.views.push_back({view.name, overlay(of_view, overrides),
                          materials_for(of_models, of_view, overrides),
                          options_for(plan.models, of_view.options, overrides.options)});
    const std::size_t count = roughnesses_of(plan.views.back().materials).size();
    if (count > kMaxRoughnesses) {
      return make_error("{}: view {}: has mirrors of {} roughnesses; at most {} are drawn",
                        input.string(), view.name, count, kMaxRoughnesses);
    }
  }
  return plan;
}

Result<std::vector<fs::path>> find_inputs(const ScenePlan& plan) {
  std::set<fs::path> inputs;
  for (const SceneModel& model : plan.models) inputs.insert(model.file);
  for (const PlannedView& view : plan.views) {
    if (!view.settings.environment || view.settings.environment->empty()) continue;
    RELIEF_TRY_ASSIGN(const auto files, environment_files(*view.settings.environment));
    inputs.insert(files.begin(), files.end());
  }
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    if (!fs::exists(input_path(input), ignored))
      return make_error("{}: there is no such file", input.string());
  }
  if (!plan.file.empty()) inputs.insert(plan.file);
  return std::vector<fs::path>(inputs.begin(), inputs.end());
}

}  // namespace relief
