// Vectors, angles and file names in a scene file. Not a public header: it needs nlohmann::json.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string_view>

#include "common/scene/json_values.h"

namespace relief {

/// Degrees: beyond a few turns only by mistake.
inline constexpr NumberRange kAngles{-1e6, 1e6};

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
