// Vectors and angles in a scene file. Not a public header: it needs nlohmann::json.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/json_values.h"

namespace relief {

/// [x, y, z], each from -kMaxSceneCoordinate to kMaxSceneCoordinate.
glm::dvec3 read_vector(JsonValues& values, const JsonNode& node);

/// [x, y, z] of any length but 0, as a unit vector: so that nothing later under- or overflows.
glm::dvec3 read_direction(JsonValues& values, const JsonNode& node);

/// Degrees; beyond a few turns only a mistake.
double read_angle(JsonValues& values, const JsonNode& node);

}  // namespace relief
