#include "common/scene/json/scene_settings_reader.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/image/srgb.h"
#include "common/scene/json/lights_reader.h"
#include "common/scene/json/vector_values.h"

namespace relief {
namespace {

constexpr NumberRange kAngles{-1e6, 1e6};
constexpr double kNearestOrbit = 1e-6;  // bounding-sphere radii

ImageSize read_size(JsonValues& values, const JsonNode& node) {
  constexpr std::string_view kExpected = "[width, height], whole numbers from 1 to 32768";
  const auto n = values.numbers(node, {2, 2}, {1.0, kMaxRenderSide}, kExpected);
  if (n.empty()) return {};
  if (n[0] != std::floor(n[0]) || n[1] != std::floor(n[1])) values.refuse_value(node, kExpected);
  return {static_cast<std::uint32_t>(n[0]), static_cast<std::uint32_t>(n[1])};
}

Orbit read_orbit(JsonValues& values, const JsonNode& node) {
  constexpr std::string_view kExpected =
      "[azimuth, elevation] or [azimuth, elevation, distance], the distance above 0";
  const auto n = values.numbers(node, {2, 3}, kAngles, kExpected);
  if (n.empty()) return {};
  if (n.size() == 3 && n[2] < kNearestOrbit) values.refuse_value(node, kExpected);
  return {n[0], n[1], n.size() == 3 ? n[2] : 0.0};
}

OrthographicSize read_orthographic(JsonValues& values, const JsonNode& node) {
  if (node.value == "fit") return {};
  return {values.number(node, {kOrthographicHeights.min, kOrthographicHeights.max},
                        "the image's height in world units, above 0, or \"fit\"")};
}

Orbit read_direction_of_view(JsonValues& values, const JsonNode& node) {
  return values.choice(node, kViews);
}

glm::dvec3 read_up(JsonValues& values, const JsonNode& node) {
  return node.value.is_string() ? values.choice(node, kAxes) : read_direction(values, node);
}

Background read_background(JsonValues& values, const JsonNode& node) {
  constexpr std::string_view kExpected = "[r, g, b], sRGB values from 0 to 1, or \"none\"";
  if (node.value == "none") return {};
  const auto n = values.numbers(node, {3, 3}, {0.0, 1.0}, kExpected);
  if (n.empty()) return {};
  const auto linear = [](double s) { return linear_from_srgb(static_cast<float>(s)); };
  return {glm::vec3(linear(n[0]), linear(n[1]), linear(n[2]))};
}

Outputs read_outputs(JsonValues& values, const JsonNode& node) {
  constexpr std::string_view kExpected =
      "a list of some of colour, normal, depth, uv, patch, clip, or \"all\"";
  Outputs outputs;
  if (node.value == "all") return {true, true, true, true};
  if (!node.value.is_array() || node.value.empty()) {
    values.refuse_value(node, kExpected);
    return outputs;
  }
  for (const nlohmann::json& name : node.value) {
    if (!name.is_string() || !add_output(outputs, name.get_ref<const std::string&>()))
      values.refuse_value({name, node.path}, kExpected);
  }
  return outputs;
}

/// The name of an engine.
std::string read_engine(JsonValues& values, const JsonNode& node, const EngineKeys& engines) {
  std::string name = node.value.is_string() ? node.value.get<std::string>() : std::string();
  const auto& known = engines.engines;
  if (std::find(known.begin(), known.end(), name) == known.end())
    values.refuse_value(node, fmt::format("{}", fmt::join(known, ", ")));
  return name;
}

int read_count(JsonValues& values, const JsonNode& node, NumberChoice range,
               std::string_view expected) {
  const double n = values.number(node, {range.min, range.max}, expected);
  if (n != std::floor(n)) values.refuse_value(node, expected);
  return static_cast<int>(n);
}

}  // namespace

std::vector<std::string_view> with_setting_keys(std::vector<std::string_view> keys,
                                                const EngineKeys& engines) {
  for (const char* key : {"size", "orbit", "view", "eye", "target", "up", "roll", "zoom", "fov",
                          "orthographic", "env", "env_rotation", "background", "edl", "outputs",
                          "lights", "ambient", "exposure", "engine"})
    keys.emplace_back(key);
  for (const OptionRow& row : engines.options) keys.emplace_back(row.key);
  keys.insert(keys.end(), kMaterialKeys.begin(), kMaterialKeys.end());
  return keys;
}

MaterialOverrides read_material(JsonValues& values, const JsonNode& object) {
  MaterialOverrides overrides;
  if (const auto node = JsonValues::member(object, "material"))
    overrides.material = values.choice(*node, kMaterials);
  if (const auto node = JsonValues::member(object, "ior")) {
    overrides.ior = values.number(*node, {kRefractiveIndices.min, kRefractiveIndices.max},
                                  "a number from 1 to 4");
  }
  if (const auto node = JsonValues::member(object, "absorption"))
    overrides.absorption = read_linear_colour(values, *node, kAbsorptions.max);
  if (const auto node = JsonValues::member(object, "interfaces"))
    overrides.interfaces = read_count(values, *node, kInterfaceCounts, "1 or 2");
  const auto read_fraction = [&](std::string_view key, NumberChoice choice) {
    const auto node = JsonValues::member(object, key);
    if (!node) return std::optional<double>();
    return std::optional(values.number(*node, {choice.min, choice.max}, "a number from 0 to 1"));
  };
  overrides.roughness = read_fraction("roughness", kRoughnesses);
  overrides.opacity = read_fraction("opacity", kOpacities);
  return overrides;
}

OptionValues read_options(JsonValues& values, const JsonNode& object,
                          const SettingsContext& context) {
  OptionValues options;
  for (const OptionRow& row : context.engines.options) {
    const auto node = JsonValues::member(object, row.key);
    if (!node) continue;
    OptionValue value = values.option(*node, row);
    const auto* const text = std::get_if<std::string>(&value);
    if (text != nullptr && !row.file_extension.empty() && text->ends_with(row.file_extension))
      value = read_path(values, *node, context.folder, expected_of(row)).string();
    options.insert_or_assign(row.key, std::move(value));
  }
  return options;
}

SceneSettings read_settings(JsonValues& values, const JsonNode& object,
                            const SettingsContext& context) {
  SceneSettings settings;
  const auto read = [&object](std::string_view key, auto& to, const auto& value_at) {
    if (const auto node = JsonValues::member(object, key)) to = value_at(*node);
  };
  const auto with = [&values](auto* read_value) {
    return [&values, read_value](const JsonNode& node) { return read_value(values, node); };
  };
  read("size", settings.size, with(read_size));
  read("orbit", settings.orbit, with(read_orbit));
  read("view", settings.orbit, with(read_direction_of_view));
  read("eye", settings.eye, with(read_vector));
  read("target", settings.target, with(read_vector));
  read("up", settings.up, with(read_up));
  read("roll", settings.roll_degrees, with(read_angle));
  read("zoom", settings.zoom, [&values](const JsonNode& node) {
    return values.number(node, {kZooms.min, kZooms.max}, "a number from 0.01 to 10000");
  });
  read("fov", settings.fov_degrees, [&values](const JsonNode& node) {
    return values.number(node, {kMinFieldOfView, kMaxFieldOfView}, "degrees from 0.01 to 175");
  });
  read("orthographic", settings.orthographic, with(read_orthographic));
  read("engine", settings.engine,
       [&](const JsonNode& node) { return read_engine(values, node, context.engines); });
  settings.options = read_options(values, object, context);
  static_cast<MaterialOverrides&>(settings) = read_material(values, object);
  read("lights", settings.lights, with(read_lights));
  read("ambient", settings.ambient,
       [&values](const JsonNode& node) { return read_linear_colour(values, node, kMaxLight); });
  read("env", settings.environment, [&](const JsonNode& node) {
    return read_path(values, node, context.folder, "the name of an environment map, EXR or HDR");
  });
  read("env_rotation", settings.environment_rotation_degrees, with(read_angle));
  read("background", settings.background, with(read_background));
  read("outputs", settings.outputs, with(read_outputs));
  read("edl", settings.eye_dome, [&values](const JsonNode& node) {
    return values.number(node, {kEyeDomes.min, kEyeDomes.max}, "a number from 0 to 100");
  });
  read("exposure", settings.exposure, [&values](const JsonNode& node) {
    return values.number(node, {kExposures.min, kExposures.max}, "stops from -20 to 20");
  });
  if (settings.orbit && (settings.eye || settings.target))
    values.refuse(object.path, "expected either an orbit or eye and target; found both");
  if (JsonValues::member(object, "orbit") && JsonValues::member(object, "view"))
    values.refuse(object.path, "expected either an orbit or a view; found both");
  if (settings.fov_degrees && settings.orthographic)
    values.refuse(object.path, "expected either fov or orthographic; found both");
  return settings;
}

std::filesystem::path read_path(JsonValues& values, const JsonNode& node,
                                const std::filesystem::path& folder, std::string_view expected) {
  const std::string name = values.text(node, expected);
  // With a zero byte it would be another file's name to the operating system.
  if (name.find('\0') != std::string::npos) values.refuse_value(node, expected);
  return folder / name;
}

}  // namespace relief
