// Scene files (docs/scene.md) to scenes.
#include <algorithm>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "common/io/file.h"
#include "common/scene/json/json_text.h"
#include "common/scene/json/json_values.h"
#include "common/scene/json/scene_settings_reader.h"
#include "common/scene/json/vector_values.h"
#include "common/scene/scene.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

constexpr NumberRange kScales{1e-9, 1e9};
constexpr std::size_t kLongestName = 100;

glm::dmat3 read_rotation(JsonValues& values, const JsonNode& node) {
  if (!values.object(node, {"axis", "degrees"})) return glm::dmat3(1.0);
  const auto axis = values.required(node, "axis", "[x, y, z]");
  const auto degrees = values.required(node, "degrees", "a number");
  if (!axis || !degrees) return glm::dmat3(1.0);
  return rotation_about(read_direction(values, *axis), read_angle(values, *degrees));
}

Transform read_transform(JsonValues& values, const JsonNode& node) {
  Transform transform;
  if (!values.object(node, {"translation", "rotation", "scale"})) return transform;
  if (const auto found = JsonValues::member(node, "translation"))
    transform.translation = read_vector(values, *found);
  if (const auto found = JsonValues::member(node, "rotation"))
    transform.rotation = read_rotation(values, *found);
  if (const auto found = JsonValues::member(node, "scale"))
    transform.scale = values.number(*found, kScales, "a number from 1e-9 to 1e9");
  return transform;
}

SceneModel read_model(JsonValues& values, const JsonNode& node, const SettingsContext& context) {
  constexpr std::string_view kExpected = "the name of a patch file, a scan, a mesh or a volume";
  SceneModel model;
  std::vector<std::string_view> keys{"file", "transform", "closed", "raw"};
  for (const OptionRow& row : context.engines.options) {
    if (row.is_of_model) keys.emplace_back(row.key);
  }
  keys.insert(keys.end(), kMaterialKeys.begin(), kMaterialKeys.end());
  if (!values.object(node, keys)) return model;
  if (const auto file = values.required(node, "file", kExpected)) {
    model.file = read_path(values, *file, context.folder, kExpected);
    if (model.file.extension() == ".json")
      values.refuse_value(*file, fmt::format("{}, not another scene", kExpected));
  }
  if (const auto found = JsonValues::member(node, "transform"))
    model.transform = read_transform(values, *found);
  if (const auto found = JsonValues::member(node, "closed"))
    model.is_closed = values.boolean(*found);
  if (const auto found = JsonValues::member(node, "raw"))
    model.raw =
        values.text(*found, "the layout of a volume without a header, as in 256x256x109:u8");
  model.options = read_options(values, node, context);
  model.material = read_material(values, node);
  return model;
}

std::string read_name(JsonValues& values, const JsonNode& node) {
  constexpr std::string_view kExpected =
      "a name of at most 100 letters, digits, -, _ and ., no . first";
  std::string name = values.text(node, kExpected);
  const bool good = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  });
  if (!good || name.size() > kLongestName || name.starts_with('.'))
    values.refuse_value(node, kExpected);
  return name;
}

SceneView read_view(JsonValues& values, const JsonNode& node, const SettingsContext& context,
                    const SceneSettings& of_all) {
  SceneView view;
  if (!values.object(node, with_setting_keys({"name"}, context.engines))) return view;
  if (const auto name = values.required(node, "name", "a name for the image"))
    view.name = read_name(values, *name);
  view.settings = read_settings(values, node, context);
  const SceneSettings all = overlay(of_all, view.settings);
  if (all.eye && all.eye == all.target) values.refuse(node.path, "the eye is where its target is");
  if (!all.eye && (view.settings.target || view.settings.up))
    values.refuse(node.path, "has a target or up, which need an eye; add an eye");
  return view;
}

Scene make_scene(JsonValues& values, const JsonNode& root, const SettingsContext& context) {
  Scene scene;
  if (!values.object(root, with_setting_keys({"models", "views"}, context.engines))) return scene;
  scene.settings = read_settings(values, root, context);
  if (const auto list = values.required(root, "models", "a list of models, at least one")) {
    for (const JsonNode& node : values.elements(*list, kMaxSceneModels, "models"))
      scene.models.push_back(read_model(values, node, context));
    if (const std::size_t count = distinct_materials(scene.models).size(); count > kMaxMaterials) {
      values.refuse(list->path, fmt::format("have {} different materials; at most {} are drawn",
                                            count, kMaxMaterials));
    }
  }
  if (const auto list = values.required(root, "views", "a list of views, at least one")) {
    std::set<std::string> names;
    for (const JsonNode& node : values.elements(*list, kMaxSceneViews, "views")) {
      scene.views.push_back(read_view(values, node, context, scene.settings));
      const std::string& name = scene.views.back().name;
      if (!names.insert(name).second)
        values.refuse(node.path + ".name",
                      fmt::format("another view has the name {}, too; rename one", name));
    }
  }
  return scene;
}

}  // namespace

Result<Scene> read_scene(const fs::path& path, const EngineKeys& engines) {
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(path));
  if (file.size() == 0) return make_error("{}: the file is empty", path.string());
  if (file.size() > kMaxSceneBytes) {
    return make_error("{}: has {} bytes; a scene file has at most {}", path.string(), file.size(),
                      kMaxSceneBytes);
  }
  std::string text(file.size(), '\0');
  RELIEF_TRY(file.read_at(0, std::as_writable_bytes(std::span<char>(text))));
  RELIEF_TRY_ASSIGN(const auto tree, parse_json(text, path.string()));
  JsonValues values(path.string());
  const fs::path folder = path.parent_path();
  Scene scene = make_scene(values, {tree, ""}, {folder, engines});
  if (values.error()) return *values.error();
  return scene;
}

}  // namespace relief
