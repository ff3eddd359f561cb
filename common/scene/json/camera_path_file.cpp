// Files of camera paths (docs/render.md).
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <span>

#include "common/io/file.h"
#include "common/scene/json/json_text.h"
#include "common/scene/json/json_values.h"
#include "common/scene/json/vector_values.h"
#include "common/scene/scene.h"
#include "common/scene/views/camera_path.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestKeyName = 1000;

std::string read_key_name(JsonValues& values, const JsonNode& node) {
  constexpr std::string_view kExpected = "a text of at most 1000 bytes";
  if (!node.value.is_string() ||
      node.value.get_ref<const std::string&>().size() > kLongestKeyName) {
    values.refuse_value(node, kExpected);
    return {};
  }
  return node.value.get<std::string>();
}

CameraKey read_key(JsonValues& values, const JsonNode& node, double usual_time) {
  CameraKey key;
  key.time = usual_time;
  if (!values.object(node, {"name", "time", "eye", "target", "up", "fov", "orthographic"}))
    return key;
  if (const auto found = JsonValues::member(node, "name")) key.name = read_key_name(values, *found);
  if (const auto found = JsonValues::member(node, "time"))
    key.time = values.number(*found, {0.0, kMaxPathTime}, "seconds from 0 to 1e6");
  Camera& camera = key.camera;
  if (const auto eye = values.required(node, "eye", "[x, y, z]"))
    camera.eye = read_vector(values, *eye);
  if (const auto target = values.required(node, "target", "[x, y, z]"))
    camera.target = read_vector(values, *target);
  if (const auto up = values.required(node, "up", "[x, y, z]"))
    camera.up = read_vector(values, *up);
  if (!(glm::length(camera.up) >= kShortestSight))
    values.refuse(node.path + ".up", "is no direction; its length is at least 1e-12");
  read_lens(values, node, camera);
  if (!(glm::distance(camera.eye, camera.target) >= kShortestSight))
    values.refuse(node.path, "the eye is where its target is");
  return key;
}

CameraPath make_path(JsonValues& values, const JsonNode& root) {
  CameraPath path;
  if (!values.object(root, {"version", "keys", "frames_per_second", "loop"})) return path;
  if (const auto version = values.required(root, "version", "1");
      version && version->value != nlohmann::json(1))
    values.refuse_value(*version, "1, the only version that there is");
  if (const auto found = JsonValues::member(root, "frames_per_second")) {
    path.frames_per_second = values.number(*found, {kFrameRates.min, kFrameRates.max},
                                           "frames per second from 1 to 240");
  }
  if (const auto found = JsonValues::member(root, "loop")) path.is_loop = values.boolean(*found);
  const auto list = values.required(root, "keys", "a list of cameras, at least two");
  if (!list) return path;
  for (const JsonNode& node : values.elements(*list, kMaxCameraKeys, "keys")) {
    const bool is_first = path.keys.empty();
    const double usual_time = is_first ? 0.0 : path.keys.back().time + kUsualStep;
    CameraKey key = read_key(values, node, usual_time);
    if (!is_first && !(key.time > path.keys.back().time)) {
      values.refuse(node.path + ".time",
                    fmt::format("is {} s, not after the {} s of the key before; times ascend",
                                key.time, path.keys.back().time));
    }
    if (!is_first && key.camera.is_orthographic() != path.keys.front().camera.is_orthographic()) {
      values.refuse(node.path,
                    "is orthographic or perspective unlike the first key; all keys are alike");
    }
    path.keys.push_back(std::move(key));
  }
  if (path.keys.size() == 1)
    values.refuse(list->path, "has a single camera; a path has at least two");
  return path;
}

}  // namespace

Result<CameraPath> parse_camera_path(std::string_view text, const std::string& name) {
  RELIEF_TRY_ASSIGN(const auto tree, parse_json(text, name));
  JsonValues values(name);
  CameraPath path = make_path(values, {tree, ""});
  if (values.error()) return *values.error();
  return path;
}

Result<CameraPath> read_camera_path(const fs::path& path) {
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(path));
  if (file.size() == 0) return make_error("{}: the file is empty", path.string());
  if (file.size() > kMaxSceneBytes) {
    return make_error("{}: has {} bytes; a camera path has at most {}", path.string(), file.size(),
                      kMaxSceneBytes);
  }
  std::string text(file.size(), '\0');
  RELIEF_TRY(file.read_at(0, std::as_writable_bytes(std::span<char>(text))));
  return parse_camera_path(text, path.string());
}

std::string camera_path_text(const CameraPath& path) {
  nlohmann::ordered_json json{{"version", 1}};
  if (path.frames_per_second) json["frames_per_second"] = *path.frames_per_second;
  if (path.is_loop) json["loop"] = true;
  json["keys"] = nlohmann::ordered_json::array();
  for (const CameraKey& key : path.keys) {
    const Camera& camera = key.camera;
    nlohmann::ordered_json entry;
    if (!key.name.empty()) entry["name"] = key.name;
    entry["time"] = key.time;
    entry["eye"] = numbers_of(camera.eye);
    entry["target"] = numbers_of(camera.target);
    entry["up"] = numbers_of(camera.up);
    entry["fov"] = camera.vertical_fov_degrees;
    if (camera.is_orthographic()) entry["orthographic"] = camera.orthographic_height;
    json["keys"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Status write_camera_path(const fs::path& file, const CameraPath& path) {
  const std::string text = camera_path_text(path);
  return write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace relief
