#include "cli/options/render_plan.h"

#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/options/paths.h"
#include "renderer/engine_registry.h"
#include "renderer/shading/environment_files.h"
#include "renderer/shading/materials.h"

namespace relief::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kViewMark = "{view}";

fs::path output_of(const fs::path& pattern, const std::string& view) {
  std::string name = pattern.string();
  for (std::size_t at = name.find(kViewMark); at != std::string::npos;
       at = name.find(kViewMark, at + view.size())) {
    name.replace(at, kViewMark.size(), view);
  }
  return name;
}

/// The materials of a view of a scene; none if the models say nothing about theirs.
std::vector<MaterialSettings> materials_for(const std::vector<MaterialWords>& of_models,
                                            const MaterialWords& of_view,
                                            const MaterialWords& of_options) {
  std::vector<MaterialSettings> materials;
  if (of_models == std::vector<MaterialWords>(1)) return materials;
  for (const MaterialWords& own : of_models)
    materials.push_back(material_of(overlay_material(overlay_material(of_view, own), of_options)));
  return materials;
}

}  // namespace

Result<RenderPlan> make_plan(const RenderArguments& arguments) {
  RenderPlan plan;
  if (ending(arguments.input) != ".json") {
    plan.models.push_back({arguments.input, {}, {}, {}});
    plan.pictures.push_back({"", arguments.output, arguments.settings, {}});
    return plan;
  }
  RELIEF_TRY_ASSIGN(auto scene, read_scene(arguments.input));
  plan.scene = arguments.input;
  plan.models = std::move(scene.models);
  const std::vector<MaterialWords> said = materials_said(plan.models);
  for (const SceneView& view : scene.views) {
    const SceneSettings of_view = overlay(scene.settings, view.settings);
    plan.pictures.push_back({view.name, output_of(arguments.output, view.name),
                             overlay(of_view, arguments.settings),
                             materials_for(said, of_view, arguments.settings)});
    const std::size_t count = roughnesses_of(plan.pictures.back().materials).size();
    if (count > kMaxRoughnesses) {
      return make_error("{}: view {}: has mirrors of {} roughnesses; at most {} are drawn",
                        arguments.input.string(), view.name, count, kMaxRoughnesses);
    }
  }
  return plan;
}

bool outputs_differ(const RenderPlan& plan, const RenderArguments& arguments) {
  return plan.pictures.size() == 1 ||
         arguments.output.string().find(kViewMark) != std::string::npos;
}

Result<std::vector<fs::path>> find_inputs(const RenderPlan& plan, const fs::path& texture) {
  std::set<fs::path> inputs;
  if (!texture.empty() && texture != "none") inputs.insert(texture);
  for (const SceneModel& model : plan.models) inputs.insert(model.file);
  for (const Picture& picture : plan.pictures) {
    if (!picture.settings.environment || picture.settings.environment->empty()) continue;
    RELIEF_TRY_ASSIGN(const auto files, environment_files(*picture.settings.environment));
    inputs.insert(files.begin(), files.end());
  }
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    if (!fs::exists(input, ignored)) return make_error("{}: there is no such file", input.string());
  }
  if (!plan.scene.empty()) inputs.insert(plan.scene);
  return std::vector<fs::path>(inputs.begin(), inputs.end());
}

Status check_files(const RenderPlan& plan, const fs::path& texture) {
  RELIEF_TRY_ASSIGN(const auto inputs, find_inputs(plan, texture));
  for (const Picture& picture : plan.pictures) {
    RELIEF_TRY(check_output(picture.output, inputs));
  }
  return {};
}

Result<RenderSettings> render_settings_for(const Picture& picture, const PatchModel& model,
                                           const RenderArguments& arguments) {
  const SceneSettings& said = picture.settings;
  const auto camera = camera_for(said, model);
  if (!camera) {
    return picture.view.empty() ? camera.error()
                                : make_error("{}: view {}: {}", arguments.input.string(),
                                             picture.view, camera.error().message);
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
  settings.materials = picture.materials;
  settings.lights.list = said.lights.value_or(std::vector<Light>());
  settings.lights.ambient = said.ambient.value_or(settings.lights.ambient);
  settings.environment = said.environment.value_or(fs::path());
  if (said.background) settings.background = said.background->colour;
  if (ending(picture.output) == ".exr")
    settings.outputs = said.outputs.value_or(Outputs{true, true, true, true});
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
  settings.platform = arguments.platform;
  settings.explain = arguments.explain;
  settings.frames = arguments.frames.value_or(0);
  settings.count_fragments = arguments.frames.has_value();
  return settings;
}

}  // namespace relief::cli
