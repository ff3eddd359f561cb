#include "viewer/settings/bookmark_settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "common/scene/camera.h"
#include "common/scene/json/json_text.h"
#include "common/scene/json/vector_values.h"
#include "viewer/navigation/pose.h"
#include "viewer/settings/paths.h"

namespace relief {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestName = 1000;  // bytes
constexpr double kMostSeconds = 1e6;        // between bookmarks

bool is_object(JsonValues& values, const JsonNode& node) {
  if (!node.value.is_object()) values.refuse_value(node, "an object");
  return node.value.is_object();
}

std::optional<Bookmark> read_bookmark(JsonValues& values, const JsonNode& node) {
  if (!is_object(values, node)) return std::nullopt;
  Bookmark made;
  const auto read = [&](std::string_view key, auto& to, const auto& reader) {
    if (const auto found = JsonValues::member(node, key)) to = reader(*found);
  };
  const auto vector = [&](const JsonNode& n) { return read_vector(values, n); };
  read("name", made.name, [&](const JsonNode& n) { return values.text(n, "a name"); });
  read("eye", made.camera.eye, vector);
  read("target", made.camera.target, vector);
  read("up", made.camera.up, vector);
  read_lens(values, node, made.camera);
  read("seconds", made.seconds, [&](const JsonNode& n) {
    return values.number(n, {1e-3, kMostSeconds}, "seconds from 0.001 to 1000000");
  });
  if (made.name.size() > kLongestName || !is_usable(made.camera)) return std::nullopt;
  return made;
}

json json_of(const Bookmark& bookmark) {
  const Camera& camera = bookmark.camera;
  json made{{"name", bookmark.name},
            {"eye", numbers_of(camera.eye)},
            {"target", numbers_of(camera.target)},
            {"up", numbers_of(camera.up)},
            {"fov", camera.vertical_fov_degrees},
            {"seconds", bookmark.seconds}};
  if (camera.is_orthographic()) made["orthographic"] = camera.orthographic_height;
  return made;
}

}  // namespace

std::vector<FileBookmarks> read_bookmarks(JsonValues& values, const JsonNode& node) {
  std::vector<FileBookmarks> all;
  if (node.value.is_array() && node.value.empty()) return all;
  for (const JsonNode& of_file :
       values.elements(node, kMostBookmarkedFiles, "files with bookmarks")) {
    if (!is_object(values, of_file)) return all;
    const auto file = values.required(of_file, "file", "a path");
    const auto views = values.required(of_file, "views", "a list of views");
    if (!file || !views) return all;
    const std::string path = values.text(*file, "a path");
    std::vector<Bookmark> list;
    for (const JsonNode& view : values.elements(*views, kMostBookmarksOfAFile, "views")) {
      if (auto bookmark = read_bookmark(values, view)) list.push_back(*std::move(bookmark));
    }
    if (is_absolute_path(path) && !list.empty()) all.push_back({path, std::move(list)});
  }
  return all;
}

json json_of(const std::vector<FileBookmarks>& all) {
  json files = json::array();
  for (const FileBookmarks& one : all) {
    json views = json::array();
    for (const Bookmark& bookmark : one.list) {
      json view = json_of(bookmark);
      if (is_utf8(view) && views.size() < kMostBookmarksOfAFile) views.push_back(std::move(view));
    }
    json file{{"file", one.file.string()}, {"views", std::move(views)}};
    if (is_utf8(file) && !file["views"].empty()) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace relief
