// The settings of a scene file and of each of its views. Not a public header: it needs
// nlohmann::json.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/json/json_values.h"
#include "common/scene/scene.h"

namespace relief {

/// The context in which read_settings reads an object.
struct SettingsContext {
  const std::filesystem::path& folder;  ///< that paths are relative to
  const EngineKeys& engines;
};

/// `keys`, and those that read_settings knows.
[[nodiscard]] std::vector<std::string_view> with_setting_keys(std::vector<std::string_view> keys,
                                                              const EngineKeys& engines);

/// The settings among the members of an object.
SceneSettings read_settings(JsonValues& values, const JsonNode& object,
                            const SettingsContext& context);

/// The values of options among the members of an object.
OptionValues read_options(JsonValues& values, const JsonNode& object,
                          const SettingsContext& context);

/// The keys of a material.
inline constexpr std::array<std::string_view, 6> kMaterialKeys{
    "material", "ior", "absorption", "roughness", "opacity", "interfaces"};

/// The material among the members of an object.
MaterialOverrides read_material(JsonValues& values, const JsonNode& object);

/// The name of a file, relative to `folder`.
std::filesystem::path read_path(JsonValues& values, const JsonNode& node,
                                const std::filesystem::path& folder, std::string_view expected);

}  // namespace relief
