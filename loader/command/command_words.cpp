#include "loader/command/command_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "common/image/srgb.h"
#include "common/scalars/colour_map.h"
#include "preprocess/readers/selection.h"

namespace relief {
namespace {

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

std::string text_of(RangeEnd end) {
  return fmt::format("{}{}", end.number, end.is_percent ? "%" : "");
}

constexpr std::array<Named<Acquisition>, 3> kAcquisitions{{{"given", Acquisition::Given},
                                                           {"ewa", Acquisition::ViewIndependent},
                                                           {"optimised", Acquisition::Optimised}}};

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

void CommandWords::add(std::string_view word) {
  line_ += (line_.empty() ? "" : " ") + shell_word(word);
}

void CommandWords::option(std::string_view name, std::string_view value) {
  add(fmt::format("--{}", name));
  add(value);
}

void CommandWords::path(const std::filesystem::path& path) {
  const std::string text = path.string();
  add(text.size() > 1 && text.front() == '-' ? "./" + text : text);
}

void CommandWords::as_is(std::string_view words) {
  if (!words.empty()) line_ += fmt::format(" {}", words);
}

float srgb_of(float linear) {
  // Or a float beside the nearest, where powers are rounded.
  const float nearest = srgb_from_linear(linear);
  const float of_byte = std::round(nearest * 255.0F) / 255.0F;
  if (linear_from_srgb(of_byte) == linear) return of_byte;
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

void add_settings(const SceneSettings& options, CommandWords& words) {
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
  add_number("env-rotation", options.environment_rotation_degrees);
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

void add_reading(const LoadOptions& load, CommandWords& words) {
  if (load.colour_by) {
    words.option("colour-by", load.colour_by->scalar);
    if (load.colour_by->map) words.option("colour-map", name_of(kColourMaps, *load.colour_by->map));
    if (const auto& range = load.colour_by->range)
      words.option("colour-range", text_of(range->low) + "," + text_of(range->high));
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
  if (load.volume.scalar) words.option("volume-scalar", *load.volume.scalar);
  if (load.volume.raw) words.option("raw", text_of(*load.volume.raw));
  if (!load.read.format.empty()) words.option("format", load.read.format);
  words.as_is(describe_classes(load.read.selection));
  if (load.read.selection.crop) words.option("crop", describe_box(*load.read.selection.crop));
}

std::string names_of(const Outputs& outputs) {
  std::string text = "colour";
  if (outputs.normal) text += ",normal";
  if (outputs.depth) text += ",depth";
  if (outputs.uv) text += ",uv";
  if (outputs.patch_id) text += ",patch";
  if (outputs.clip) text += ",clip";
  return text;
}

}  // namespace relief
