#include "loader/view_settings.h"

#include <utility>

namespace relief {

Result<RenderSettings> render_settings_of(const ScenePlan& plan, const PlannedView& view,
                                          const PatchModel& extent) {
  const SceneSettings& said = view.settings;
  const auto camera = camera_for(said, extent);
  if (!camera) {
    return view.name.empty() ? camera.error()
                             : make_error("{}: view {}: {}", plan.file.string(), view.name,
                                          camera.error().message);
  }
  RenderSettings settings;
  const ImageSize size = said.size.value_or(ImageSize{});
  settings.width = size.width;
  settings.height = size.height;
  settings.camera = *camera;
  settings.engine = said.engine.value_or(settings.engine);
  const bool splats = settings.engine == "multipass";
  settings.primitive = said.primitive.value_or(splats ? Primitive::Quad : settings.primitive);
  settings.interpolation = said.interpolation.value_or(settings.interpolation);
  settings.cull = said.cull.value_or(settings.cull);
  const MaterialSettings material = material_of(said);
  settings.material = material.kind;
  settings.constants = material.constants;
  settings.materials = view.materials;
  settings.lights.list = said.lights.value_or(std::vector<Light>());
  settings.lights.ambient = said.ambient.value_or(settings.lights.ambient);
  settings.environment = said.environment.value_or(std::filesystem::path());
  if (said.background) settings.background = said.background->colour;
  settings.outputs = said.outputs.value_or(settings.outputs);
  settings.pixels_per_sample = said.pixels_per_sample;
  settings.multipass.radius_factor = said.radius_factor.value_or(settings.multipass.radius_factor);
  settings.samples = said.samples.value_or(settings.samples);
  settings.raytrace.samples = said.samples.value_or(settings.raytrace.samples);
  settings.ewa.filter = said.filter.value_or(settings.ewa.filter);
  settings.ewa.cutoff = said.cutoff.value_or(settings.ewa.cutoff);
  settings.ewa.layers = said.layers.value_or(settings.ewa.layers);
  settings.ewa.coverage_threshold =
      said.coverage_threshold.value_or(settings.ewa.coverage_threshold);
  settings.ewa.time_budget_ms = said.time_budget_ms.value_or(settings.ewa.time_budget_ms);
  return settings;
}

Result<std::vector<RenderSettings>> render_settings_of(const ScenePlan& plan,
                                                       const PatchModel& extent) {
  std::vector<RenderSettings> views;
  views.reserve(plan.views.size());
  for (const PlannedView& view : plan.views) {
    RELIEF_TRY_ASSIGN(auto settings, render_settings_of(plan, view, extent));
    views.push_back(std::move(settings));
  }
  return views;
}

}  // namespace relief
