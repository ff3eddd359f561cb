// Vectors, angles and lenses in files of JSON. Not a public header: it needs nlohmann::json.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "common/scene/camera.h"
#include "common/scene/json/json_values.h"

namespace relief {

/// [x, y, z], each from -kMaxSceneCoordinate to kMaxSceneCoordinate.
glm::dvec3 read_vector(JsonValues& values, const JsonNode& node);

/// [x, y, z] of any length but 0, as a unit vector: so that nothing later under- or overflows.
glm::dvec3 read_direction(JsonValues& values, const JsonNode& node);

/// Degrees; beyond a few turns only a mistake.
double read_angle(JsonValues& values, const JsonNode& node);

/// The lens of a camera, "fov" and "orthographic", where an object has them.
void read_lens(JsonValues& values, const JsonNode& object, Camera& camera);

/// A vector as read_vector() takes it.
[[nodiscard]] inline std::array<double, 3> numbers_of(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}

}  // namespace relief
