#include "viewer/settings/preferences.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "common/scene/json/json_text.h"
#include "common/scene/json/json_values.h"
#include "viewer/settings/bookmark_settings.h"
#include "viewer/settings/paths.h"

namespace relief {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostSections = 64;

double read_number(JsonValues& values, const JsonNode& node, NumberChoice range) {
  return values.number(node, {range.min, range.max},
                       fmt::format("a number from {:g} to {:g}", range.min, range.max));
}

glm::ivec2 read_window(JsonValues& values, const JsonNode& node) {
  const std::vector<double> sides =
      values.numbers(node, {2, 2}, {kWindowSides.min, kWindowSides.max}, "[width, height]");
  return sides.empty() ? Preferences().window
                       : glm::ivec2(static_cast<int>(sides[0]), static_cast<int>(sides[1]));
}

std::vector<fs::path> read_paths(JsonValues& values, const JsonNode& node, std::size_t most) {
  std::vector<fs::path> paths;
  if (node.value.is_array() && node.value.empty()) return paths;
  for (const JsonNode& element : values.elements(node, most, "paths")) {
    const std::string text = values.text(element, "a path");
    if (is_absolute_path(text)) paths.emplace_back(text);
  }
  return paths;
}

std::map<std::string, bool, std::less<>> read_sections(JsonValues& values, const JsonNode& node) {
  std::map<std::string, bool, std::less<>> sections;
  if (!node.value.is_object() || node.value.size() > kMostSections) {
    values.refuse_value(node, fmt::format("an object with at most {} sections", kMostSections));
    return sections;
  }
  for (const auto& [title, open] : node.value.items())
    sections.emplace(title, values.boolean({open, fmt::format("{}.{}", node.path, title)}));
  return sections;
}

MaterialConstants read_material(JsonValues& values, const JsonNode& node) {
  MaterialConstants made;
  if (!node.value.is_object()) {
    values.refuse_value(node, "an object");
    return made;
  }
  if (const auto found = JsonValues::member(node, "ior"))
    made.ior = static_cast<float>(read_number(values, *found, kRefractiveIndices));
  if (const auto found = JsonValues::member(node, "absorption")) {
    const auto n =
        values.numbers(*found, {3, 3}, {kAbsorptions.min, kAbsorptions.max}, "[r, g, b]");
    if (!n.empty()) made.absorption = glm::vec3(n[0], n[1], n[2]);
  }
  if (const auto found = JsonValues::member(node, "roughness"))
    made.roughness = static_cast<float>(read_number(values, *found, kRoughnesses));
  return made;
}

json texts_of(const std::vector<fs::path>& paths) {
  json list = json::array();
  for (const fs::path& path : paths) {
    json text = path.string();
    if (is_utf8(text)) list.push_back(std::move(text));
  }
  return list;
}

}  // namespace

void remember(std::vector<fs::path>& list, const fs::path& path, std::size_t most) {
  fs::path whole = whole_path(path);
  if (whole.empty()) return;
  std::erase(list, whole);
  list.insert(list.begin(), std::move(whole));
  if (list.size() > most) list.resize(most);
}

Result<Preferences> parse_preferences(std::string_view text, const std::string& name) {
  RELIEF_TRY_ASSIGN(const json tree, parse_json(text, name));
  JsonValues values(name);
  const JsonNode root{tree, ""};
  if (!tree.is_object()) {
    values.refuse_value(root, "an object");
    return *values.error();
  }
  Preferences made;
  const auto read = [&](std::string_view key, auto& to, auto&& reader) {
    if (const auto found = JsonValues::member(root, key)) to = reader(*found);
  };
  read("window", made.window, [&](const JsonNode& n) { return read_window(values, n); });
  read("panels", made.shows_panels, [&](const JsonNode& n) { return values.boolean(n); });
  read("sections", made.sections, [&](const JsonNode& n) { return read_sections(values, n); });
  read("recent_files", made.recent_files,
       [&](const JsonNode& n) { return read_paths(values, n, kMostRecentFiles); });
  read("recent_environments", made.recent_environments,
       [&](const JsonNode& n) { return read_paths(values, n, kMostRecentEnvironments); });
  read("target_ms", made.target_ms,
       [&](const JsonNode& n) { return read_number(values, n, kTargetMs); });
  read("orbit", made.orbit_style,
       [&](const JsonNode& n) { return values.choice(n, kOrbitStyles); });
  read("material", made.material, [&](const JsonNode& n) { return read_material(values, n); });
  read("bookmarks", made.bookmarks, [&](const JsonNode& n) { return read_bookmarks(values, n); });
  if (values.error()) return *values.error();
  return made;
}

std::string preferences_text(const Preferences& preferences) {
  json tree;
  tree["window"] = {preferences.window.x, preferences.window.y};
  tree["panels"] = preferences.shows_panels;
  tree["sections"] = preferences.sections;
  tree["recent_files"] = texts_of(preferences.recent_files);
  tree["recent_environments"] = texts_of(preferences.recent_environments);
  tree["target_ms"] = preferences.target_ms;
  tree["orbit"] = name_of(kOrbitStyles, preferences.orbit_style);
  const MaterialConstants& material = preferences.material;
  tree["material"] = {
      {"ior", material.ior},
      {"absorption", {material.absorption.r, material.absorption.g, material.absorption.b}},
      {"roughness", material.roughness}};
  tree["bookmarks"] = json_of(preferences.bookmarks);
  return tree.dump(2) + "\n";
}

}  // namespace relief
