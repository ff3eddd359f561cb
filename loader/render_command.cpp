#include "loader/render_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "common/image/srgb.h"
#include "common/scalars/colour_map.h"
#include "common/scalars/scalar_names.h"
#include "loader/first_look.h"
#include "loader/view_settings.h"
#include "preprocess/readers/selection.h"
#include "renderer/shading/materials.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Collects the words of a command.
class Words {
 public:
  void add(std::string_view word) { line_ += (line_.empty() ? "" : " ") + shell_word(word); }
  void option(std::string_view name, std::string_view value) {
    add(fmt::format("--{}", name));
    add(value);
  }
  /// What is quoted already, or needs no quotes.
  void as_is(std::string_view words) {
    if (!words.empty()) line_ += fmt::format(" {}", words);
  }
  [[nodiscard]] std::string take() { return std::move(line_); }

 private:
  std::string line_;
};

std::string text_of(glm::dvec3 v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

/// The shortest decimal that becomes the float again when it is read as a double.
std::string text_of(float value) {
  std::string text = fmt::format("{}", value);
  return static_cast<float>(std::stod(text)) == value ? text : fmt::format("{}", double{value});
}

std::string text_of(glm::vec3 v) {
  return fmt::format("{},{},{}", text_of(v.x), text_of(v.y), text_of(v.z));
}

std::string text_of(const OptionValue& value) {
  const auto* const number = std::get_if<double>(&value);
  return number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(value);
}

/// The sRGB value whose light a linear value is: the nearest float, or one beside it where powers
/// are rounded.
float srgb_of(float linear) {
  const float nearest = srgb_from_linear(linear);
  const float eighth = std::round(nearest * 255.0F) / 255.0F;
  if (linear_from_srgb(eighth) == linear) return eighth;
  float below = nearest;
  float above = nearest;
  constexpr int kNeighbours = 16;
  for (int k = 0; k < kNeighbours; ++k) {
    if (linear_from_srgb(below) == linear) return below;
    if (linear_from_srgb(above) == linear) return above;
    below = std::nextafter(below, 0.0F);
    above = std::nextafter(above, 1.0F);
  }
  return nearest;
}

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
  return a.ambient == b.ambient && a.from_environment == b.from_environment &&
         std::ranges::equal(a.list, b.list,
                            [](const Light& x, const Light& y) { return is_same(x, y); });
}

/// Whether the same is seen where the model is not.
bool is_same_behind(const RenderSettings& a, const RenderSettings& b) {
  if (has_backdrop(a) && has_backdrop(b)) return true;  // and no colour behind it
  return a.background == b.background && has_backdrop(a) == has_backdrop(b);
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
  check(is_same_behind(view, made), "the background: no sRGB colour has just this light");
  return missing;
}

/// Appends the options of a view.
void add_settings(const SceneSettings& options, Words& words) {
  const auto add_float = [&words](const char* name, const std::optional<double>& value) {
    if (value) words.option(name, text_of(static_cast<float>(*value)));
  };
  const auto add_number = [&words](const char* name, const auto& value) {
    if (value) words.option(name, fmt::format("{}", *value));
  };
  if (options.size)
    words.option("size", fmt::format("{}x{}", options.size->width, options.size->height));
  if (options.eye) words.option("eye", text_of(*options.eye));
  if (options.target) words.option("target", text_of(*options.target));
  if (options.up) {
    const std::string_view axis = name_of(kAxes, *options.up);
    words.option("up", axis.empty() ? text_of(*options.up) : axis);
  }
  add_number("roll", options.roll_degrees);
  add_number("zoom", options.zoom);
  add_number("fov", options.fov_degrees);
  if (options.orthographic) add_number("orthographic", options.orthographic->height);
  if (options.engine) words.option("engine", *options.engine);
  for (const auto& [key, value] : options.options) words.option(key, text_of(value));
  if (options.material) words.option("material", name_of(kMaterials, *options.material));
  add_float("ior", options.ior);
  if (options.absorption) words.option("absorption", text_of(*options.absorption));
  add_number("interfaces", options.interfaces);
  add_float("roughness", options.roughness);
  add_float("opacity", options.opacity);
  if (options.environment) words.option("env", options.environment->string());
  for (const Light& light : options.lights.value_or(std::vector<Light>())) {
    words.option("light", fmt::format("{}{},{}", light.kind == LightKind::Point ? "point:" : "",
                                      text_of(light.position), text_of(light.colour)));
  }
  if (options.ambient) words.option("ambient", text_of(*options.ambient));
  if (options.background) {
    const auto& colour = options.background->colour;
    words.option("background", colour ? text_of(glm::vec3(srgb_of(colour->r), srgb_of(colour->g),
                                                          srgb_of(colour->b)))
                                      : "none");
  }
  add_number("edl", options.eye_dome);
}

std::string text_of(RangeEnd end) {
  return fmt::format("{}{}", end.number, end.is_percent ? "%" : "");
}

constexpr std::array<Named<Acquisition>, 3> kAcquisitions{{{"given", Acquisition::Given},
                                                           {"ewa", Acquisition::ViewIndependent},
                                                           {"optimised", Acquisition::Optimised}}};

/// Appends how the model is read and coloured.
void add_reading(const CommandedImage& image, Words& words) {
  const LoadOptions& load = image.load;
  if (load.colour_by) {
    words.option("colour-by", load.colour_by->scalar);
    if (load.colour_by->map) words.option("colour-map", name_of(kColourMaps, *load.colour_by->map));
    if (const auto& range = load.colour_by->range)
      words.option("colour-range", text_of(range->low) + "," + text_of(range->high));
    if (!image.has_legend) words.add("--no-legend");
  }
  if (load.textures.left_out || !load.textures.image.empty())
    words.option("texture", load.textures.left_out ? "none" : load.textures.image.string());
  if (load.textures.flips_v) words.add("--flip-v");
  if (!load.textures.image.empty()) {
    const AcquireOptions usual;
    if (load.acquisition.acquisition != usual.acquisition)
      words.option("acquisition", name_of(kAcquisitions, load.acquisition.acquisition));
    if (load.acquisition.points != usual.points)
      words.option("points", fmt::format("{}", load.acquisition.points));
  }
  if (!load.read.format.empty()) words.option("format", load.read.format);
  words.as_is(describe_classes(load.read.selection));
  if (load.read.selection.crop) words.option("crop", describe_box(*load.read.selection.crop));
}

/// A path that is not taken for an option.
std::string path_word(const fs::path& path) {
  const std::string text = path.string();
  return text.size() > 1 && text.front() == '-' ? "./" + text : text;
}

std::string text_of_outputs(const Outputs& outputs) {
  std::string text = "colour";
  if (outputs.normal) text += ",normal";
  if (outputs.depth) text += ",depth";
  if (outputs.uv) text += ",uv";
  if (outputs.patch_id) text += ",patch";
  return text;
}

}  // namespace

std::string shell_word(std::string_view word) {
  constexpr std::string_view kPlain = "@%+=:,./-_";
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           kPlain.find(c) != std::string_view::npos;
  });
  if (is_plain) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

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

  Words words;
  words.add("relief");
  words.add("render");
  words.add(path_word(plan.file.empty() ? plan.models.front().file : plan.file));
  words.add("-o");
  words.add(path_word(image.output));
  add_settings(options, words);
  const double planned = commanded.planned().exposure.value_or(0.0);
  if (image.exposure.value_or(planned) != planned)
    words.option("exposure", fmt::format("{}", *image.exposure));
  if (image.outputs) words.option("outputs", text_of_outputs(*image.outputs));
  add_reading(image, words);

  RenderCommand command{words.take(), find_missing(view, made, *engine)};
  if (plan.file.empty() && plan.models.size() > 1)
    command.missing.emplace_back("the other models: write a scene file that names all");
  if (plan.views.size() > 1)
    command.missing.emplace_back("the view: the command makes all views of the scene");
  return command;
}

}  // namespace relief
