// What a scene file and each of its views say about pictures. Not a public header: it needs
// nlohmann::json.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/json_values.h"
#include "common/scene/scene.h"

namespace relief {

/// `keys`, and those that read_settings knows.
[[nodiscard]] std::vector<std::string_view> with_setting_keys(std::vector<std::string_view> keys);

/// The settings among the members of an object; paths in them are relative to `folder`.
SceneSettings read_settings(JsonValues& values, const JsonPlace& object,
                            const std::filesystem::path& folder);

/// The keys of what is said about a material.
inline constexpr std::array<std::string_view, 6> kMaterialKeys{
    "material", "ior", "absorption", "roughness", "opacity", "interfaces"};

/// What the members of an object say about a material.
MaterialWords read_material(JsonValues& values, const JsonPlace& object);

/// The name of a file, relative to `folder`.
std::filesystem::path read_path(JsonValues& values, const JsonPlace& place,
                                const std::filesystem::path& folder, std::string_view expected);

/// [x, y, z], each from -kMaxSceneCoordinate to kMaxSceneCoordinate.
glm::dvec3 read_vector(JsonValues& values, const JsonPlace& place);

/// [x, y, z] of any length but 0, as a unit vector: so that nothing later under- or overflows.
glm::dvec3 read_direction(JsonValues& values, const JsonPlace& place);

/// Degrees; beyond a few turns only a mistake.
double read_angle(JsonValues& values, const JsonPlace& place);

}  // namespace relief
