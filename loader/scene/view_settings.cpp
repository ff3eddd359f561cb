#include "loader/scene/view_settings.h"

#include <string>
#include <utility>

#include "common/scene/views/first_lights.h"
#include "common/scene/views/view_camera.h"
#include "renderer/shading/materials.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Applies those options that are the engine's.
Status apply_own(const EngineEntry& engine, const OptionValues& options, RenderSettings& settings) {
  OptionValues own;
  for (const auto& [key, value] : options) {
    if (find_option(engine, key) != nullptr) own.emplace(key, value);
  }
  return apply_options(engine, own, settings);
}

/// The engine's defaults, and those of the options that are its own, or those of the engine that
/// draws surfaces for it.
Result<RenderSettings> engine_settings(const PlannedView& view,
                                       std::span<const EngineEntry> among) {
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_of(view, among));
  RenderSettings settings = default_settings(*engine);
  if (const EngineEntry* const beside = find_engine(engine->surfaces_by, among))
    RELIEF_TRY(apply_own(*beside, view.settings.options, settings));
  RELIEF_TRY(apply_own(*engine, view.settings.options, settings));
  for (const OptionValues& of_model : view.options_of_models) {
    RenderSettings own = settings;
    RELIEF_TRY(apply_own(*engine, of_model, own));
    settings.volumes.push_back(std::move(own.volume));
  }
  if (settings.volumes.size() == 1) {
    settings.volume = VolumeSettings(settings.volumes.front());
    settings.volumes.clear();
  }
  return settings;
}

/// An error with the view's name before it.
Error in_view(const ScenePlan& plan, const PlannedView& view, const Error& error) {
  if (view.name.empty()) return error;
  return make_error("{}: view {}: {}", plan.file.string(), view.name, error.message);
}

/// Surfaces that are lit scatter and reflect the environment. Lights that the plan names add to it.
void light_by_environment(const SceneSettings& planned, RenderSettings& settings) {
  settings.lights.from_environment = true;
  settings.lights.ambient = planned.ambient.value_or(glm::vec3(0.0F));
  if (settings.material == Material::Lit) settings.constants.roughness = shared::kLitRoughness;
  for (MaterialSettings& material : settings.materials) {
    if (material.kind == Material::Lit) material.constants.roughness = shared::kLitRoughness;
  }
}

/// Whether lights depend on the model: one surface, and nothing that the plan says of them. Grids
/// and Gaussians are lit from the camera.
bool has_first_lights(const ScenePlan& plan, const PlannedView& view,
                      const RenderSettings& settings, std::span<const EngineEntry> among) {
  const auto engine = engine_of(view, among);
  return plan.models.size() == 1 && !view.settings.lights && !settings.lights.from_environment &&
         engine && (*engine)->surfaces_by.empty();
}

/// The views, or the frames of the film.
std::vector<PlannedView> planned_frames(const ScenePlan& plan, const PatchModel& extent) {
  if (plan.film_frames == 0) return plan.views;
  std::vector<PlannedView> frames(plan.film_frames, plan.views.front());
  if (!plan.film_cameras.empty()) {
    for (std::size_t i = 0; i < frames.size(); ++i)
      frames[i].settings = with_camera(std::move(frames[i].settings), plan.film_cameras[i]);
    return frames;
  }
  const auto settings = film_frames(plan.views.front().settings, extent, plan.film_frames);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].settings = settings[i];
  return frames;
}

}  // namespace

Result<const EngineEntry*> engine_of(const PlannedView& view, std::span<const EngineEntry> among) {
  return engine_named(view.settings.engine.value_or(among.front().name), among);
}

Result<RenderSettings> look_of(const ScenePlan& plan, const PlannedView& view,
                               std::span<const EngineEntry> among) {
  const SceneSettings& planned = view.settings;
  auto made = engine_settings(view, among);
  if (!made) return in_view(plan, view, made.error());
  RenderSettings settings = *std::move(made);
  const ImageSize size = planned.size.value_or(ImageSize{});
  settings.width = size.width;
  settings.height = size.height;
  const MaterialSettings material = material_of(planned);
  settings.material = material.kind;
  settings.constants = material.constants;
  settings.materials = view.materials;
  settings.lights.list = planned.lights.value_or(std::vector<Light>());
  settings.lights.ambient = planned.ambient.value_or(settings.lights.ambient);
  settings.environment = planned.environment.value_or(std::filesystem::path());
  settings.environment_rotation_degrees = planned.environment_rotation_degrees.value_or(0.0);
  if (!settings.environment.empty() && uses(settings, Material::Lit))
    light_by_environment(planned, settings);
  if (planned.background) settings.background = planned.background->colour;
  settings.shows_environment = !planned.background;
  settings.eye_dome = planned.eye_dome.value_or(0.0);
  settings.outputs = planned.outputs.value_or(settings.outputs);
  return settings;
}

Result<RenderSettings> render_settings_of(const ScenePlan& plan, const PlannedView& view,
                                          const PatchModel& extent,
                                          std::span<const EngineEntry> among) {
  const auto camera = camera_for(view.settings, extent);
  if (!camera) return in_view(plan, view, camera.error());
  RELIEF_TRY_ASSIGN(RenderSettings settings, look_of(plan, view, among));
  settings.camera = *camera;
  settings.environment_stance = stance_of(view.settings, extent);
  if (has_first_lights(plan, view, settings, among))
    settings.lights = first_lights(view.settings, extent);
  return settings;
}

Result<std::vector<RenderSettings>> render_settings_of(const ScenePlan& plan,
                                                       const PatchModel& extent,
                                                       std::span<const EngineEntry> among) {
  std::vector<RenderSettings> views;
  for (const PlannedView& view : planned_frames(plan, extent)) {
    RELIEF_TRY_ASSIGN(auto settings, render_settings_of(plan, view, extent, among));
    views.push_back(std::move(settings));
  }
  return views;
}

}  // namespace relief
