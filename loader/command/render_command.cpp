#include "loader/command/render_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "common/image/srgb.h"
#include "common/scalars/scalar_names.h"
#include "loader/command/command_words.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "renderer/shading/materials.h"

namespace relief {
namespace {

bool is_same(const Camera& a, const Camera& b) {
  if (a.is_orthographic() != b.is_orthographic()) return false;
  const bool same_size = a.is_orthographic() ? a.orthographic_height == b.orthographic_height
                                             : a.vertical_fov_degrees == b.vertical_fov_degrees;
  return a.eye == b.eye && a.target == b.target && a.up == b.up && same_size;
}

/// Whether two cameras differ by the rounding of their axes only, as if the up direction of one of
/// them is at a right angle to the line of sight.
bool is_nearly_same(const Camera& a, const Camera& b) {
  constexpr double kRounding = 1e-12;
  Camera with_up = b;
  with_up.up = a.up;
  const glm::dmat3 difference = view_rotation(a) - view_rotation(b);
  double most = 0.0;
  for (const glm::length_t c : {0, 1, 2}) most = std::max(most, glm::length(difference[c]));
  return is_same(a, with_up) && most <= kRounding;
}

bool is_same(const Light& a, const Light& b) {
  return a.kind == b.kind && a.position == b.position && a.colour == b.colour;
}

bool is_same(const Lights& a, const Lights& b) {
  return a.ambient == b.ambient && a.highlight == b.highlight &&
         a.from_environment == b.from_environment &&
         std::ranges::equal(a.list, b.list,
                            [](const Light& x, const Light& y) { return is_same(x, y); });
}

/// Whether the same is seen where the model is not.
bool is_same_behind(const RenderSettings& a, const RenderSettings& b) {
  if (has_backdrop(a) && has_backdrop(b)) return true;  // and no colour behind it
  return a.background == b.background && has_backdrop(a) == has_backdrop(b);
}

/// Whether it matters how the environment stands.
bool sees_environment(const RenderSettings& settings) {
  return reflects(settings) || has_backdrop(settings);
}

/// A material without the parameters that it does not use.
MaterialSettings as_used(MaterialSettings material, const Lights& lights) {
  MaterialConstants used;
  used.opacity = material.constants.opacity;
  if (material.kind == Material::Glass) {
    used.ior = material.constants.ior;
    used.absorption = material.constants.absorption;
    used.interfaces = material.constants.interfaces;
  } else if (material.kind != Material::Unlit &&
             (material.kind != Material::Lit || lights.from_environment)) {
    used.roughness = material.constants.roughness;
  }
  material.constants = used;
  return material;
}

bool has_same_materials(const RenderSettings& a, const RenderSettings& b) {
  return std::ranges::equal(materials_of(a), materials_of(b), [&](const auto& x, const auto& y) {
    return as_used(x, a.lights) == as_used(y, b.lights);
  });
}

bool is_lit(const RenderSettings& settings) {
  return uses(settings, Material::Lit) || uses(settings, Material::Split);
}

/// What the command line makes of a view of a plan.
class Commanded {
 public:
  Commanded(const ScenePlan& plan, const LoadedScene& scene, std::size_t view,
            std::span<const EngineEntry> among)
      : plan_(plan), scene_(scene), view_(plan.views[view]), among_(among) {}

  /// The renderer's settings with these options.
  [[nodiscard]] Result<RenderSettings> with(const SceneSettings& options) const {
    PlannedView view = view_;
    view.settings = overlay(view_.settings, options);
    RELIEF_TRY_ASSIGN(auto settings, render_settings_of(plan_, view, scene_.patches, among_));
    complete_look(view, scene_, settings);
    return settings;
  }
  [[nodiscard]] const SceneSettings& planned() const { return view_.settings; }
  [[nodiscard]] glm::dvec3 up() const {
    return view_.settings.up.value_or(scene_.patches.stance.up);
  }

 private:
  const ScenePlan& plan_;
  const LoadedScene& scene_;
  const PlannedView& view_;
  std::span<const EngineEntry> among_;
};

// Each of these compares with what the command does by itself (`usual`), and adds options.

/// `keeps_up`: --up has another meaning, too, and is left as it is.
void choose_camera(const Commanded& commanded, const RenderSettings& usual,
                   const RenderSettings& view, bool keeps_up, SceneSettings& options) {
  if (is_same(usual.camera, view.camera)) return;
  const SceneSettings& planned = commanded.planned();
  const Camera& camera = view.camera;
  options.eye = camera.eye;
  options.target = camera.target;
  if (camera.up != commanded.up() && !keeps_up) options.up = camera.up;
  const double usual_fov = planned.fov_degrees.value_or(Camera().vertical_fov_degrees);
  if (camera.is_orthographic())
    options.orthographic = OrthographicSize{camera.orthographic_height};
  else if (planned.orthographic || camera.vertical_fov_degrees != usual_fov)
    options.fov_degrees = camera.vertical_fov_degrees;
  if (planned.roll_degrees.value_or(0.0) != 0.0) options.roll_degrees = 0.0;
  if (planned.zoom.value_or(1.0) != 1.0) options.zoom = 1.0;
}

/// Each option once those before it are set: some defaults follow others.
void choose_engine_options(const EngineEntry& engine, RenderSettings usual,
                           const RenderSettings& view, SceneSettings& options) {
  for (const EngineOption& option : engine.options) {
    const auto value = option.get(view);
    if (!value || value == option.get(usual) || !check_value(option.row, *value)) continue;
    options.options.insert_or_assign(option.row.key, *value);
    option.set(usual, *value);
  }
}

void choose_parameters(const RenderSettings& usual, const RenderSettings& view,
                       SceneSettings& options) {
  const MaterialConstants had = as_used({usual.material, usual.constants}, usual.lights).constants;
  const MaterialConstants has = as_used({view.material, view.constants}, view.lights).constants;
  if (has.ior != had.ior) options.ior = has.ior;
  if (has.absorption != had.absorption) options.absorption = has.absorption;
  if (has.interfaces != had.interfaces) options.interfaces = has.interfaces;
  // That of what an environment lights is no option.
  if (view.material != Material::Lit && has.roughness != had.roughness)
    options.roughness = has.roughness;
  if (has.opacity != had.opacity) options.opacity = has.opacity;
}

/// What the command line makes of a background.
Background sayable(const std::optional<glm::vec3>& colour) {
  if (!colour) return {};
  const auto read = [](float linear) { return linear_from_srgb(srgb_of(linear)); };
  return {glm::vec3(read(colour->r), read(colour->g), read(colour->b))};
}

void choose_light(const RenderSettings& usual, const RenderSettings& view, SceneSettings& options) {
  if (!is_same_behind(usual, view)) options.background = sayable(view.background);
  if (view.eye_dome != usual.eye_dome) options.eye_dome = view.eye_dome;
  if (!is_lit(view) || is_same(view.lights, usual.lights)) return;
  if (!view.lights.list.empty()) options.lights = view.lights.list;
  if (view.lights.ambient != usual.lights.ambient) options.ambient = view.lights.ambient;
}

/// All options that an image needs.
Result<SceneSettings> choose_options(const Commanded& commanded, const RenderSettings& view,
                                     const EngineEntry& engine, bool keeps_up) {
  SceneSettings options;
  RELIEF_TRY_ASSIGN(RenderSettings usual, commanded.with(options));
  if (view.width != usual.width || view.height != usual.height)
    options.size = ImageSize{view.width, view.height};
  if (view.engine != usual.engine) options.engine = view.engine;
  if (view.material != usual.material) options.material = view.material;
  if (view.environment != usual.environment) options.environment = view.environment;
  if (sees_environment(view) &&
      view.environment_rotation_degrees != usual.environment_rotation_degrees)
    options.environment_rotation_degrees = view.environment_rotation_degrees;
  // What else the command does follows from these.
  RELIEF_TRY_ASSIGN(usual, commanded.with(options));
  choose_camera(commanded, usual, view, keeps_up, options);
  choose_engine_options(engine, usual, view, options);
  choose_parameters(usual, view, options);
  choose_light(usual, view, options);
  return options;
}

/// What differs between an image and that of the command.
std::vector<std::string> find_missing(const RenderSettings& view, const RenderSettings& made,
                                      const EngineEntry& engine) {
  std::vector<std::string> missing;
  const auto check = [&missing](bool is_said, std::string clause) {
    if (!is_said) missing.push_back(std::move(clause));
  };
  check(is_same(view.camera, made.camera) || is_nearly_same(view.camera, made.camera),
        "the camera: its up direction is not the model's, which --colour-by height is along");
  for (const EngineOption& option : engine.options) {
    check(option.get(view) == option.get(made),
          fmt::format("--{}: it is turned off here, which is no value of it", option.row.key));
  }
  check(has_same_materials(view, made),
        "the materials: those of the models of a scene stand in its file");
  check(!is_lit(view) || is_same(view.lights, made.lights),
        "the lights: --light adds some, but none take away those of a scene");
  check(view.environment == made.environment, "the environment: a scene's is not left out");
  check(!sees_environment(view) || view.environment_stance == made.environment_stance,
        "how the environment stands: beside --eye, --up is the camera's");
  check(is_same_behind(view, made), "the background: no sRGB colour has just this light");
  return missing;
}

}  // namespace

Result<RenderCommand> render_command(const ScenePlan& plan, const LoadedScene& scene,
                                     const RenderSettings& view, const CommandedImage& image,
                                     std::span<const EngineEntry> among) {
  assert(image.view < plan.views.size() && "a view of the plan");
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named(view.engine, among));
  const Commanded commanded(plan, scene, image.view, among);
  // Heights are along the image's up direction.
  const bool keeps_up = image.load.colour_by && image.load.colour_by->scalar == kHeightScalar;
  RELIEF_TRY_ASSIGN(const SceneSettings options,
                    choose_options(commanded, view, *engine, keeps_up));
  RELIEF_TRY_ASSIGN(const RenderSettings made, commanded.with(options));

  CommandWords words;
  words.add("relief");
  words.add("render");
  words.path(plan.file.empty() ? plan.models.front().file : plan.file);
  words.add("-o");
  words.path(image.output);
  add_settings(options, words);
  const double planned = commanded.planned().exposure.value_or(0.0);
  if (image.exposure.value_or(planned) != planned)
    words.option("exposure", fmt::format("{}", *image.exposure));
  if (image.outputs) words.option("outputs", names_of(*image.outputs));
  add_reading(image.load, words);
  if (image.load.colour_by && !image.has_legend) words.add("--no-legend");

  RenderCommand command{words.take(), find_missing(view, made, *engine)};
  if (plan.file.empty() && plan.models.size() > 1)
    command.missing.emplace_back("the other models: write a scene file that names all");
  if (plan.views.size() > 1)
    command.missing.emplace_back("the view: the command makes all views of the scene");
  return command;
}

}  // namespace relief
