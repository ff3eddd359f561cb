#include "common/scene/json/vector_values.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/scene/scene.h"

namespace relief {
namespace {

constexpr NumberRange kCoordinates{-kMaxSceneCoordinate, kMaxSceneCoordinate};
constexpr double kShortestDirection = 1e-12;
constexpr NumberRange kAngleRange{-1e6, 1e6};

}  // namespace

glm::dvec3 read_vector(JsonValues& values, const JsonNode& node) {
  const auto n = values.numbers(node, {3, 3}, kCoordinates, "[x, y, z], three numbers");
  return n.empty() ? glm::dvec3(0.0) : glm::dvec3(n[0], n[1], n[2]);
}

glm::dvec3 read_direction(JsonValues& values, const JsonNode& node) {
  const glm::dvec3 v = read_vector(values, node);
  const double length = glm::length(v);
  if (length > kShortestDirection) return v / length;
  values.refuse_value(node, "[x, y, z] longer than 0");
  return {0.0, 1.0, 0.0};
}

double read_angle(JsonValues& values, const JsonNode& node) {
  return values.number(node, kAngleRange, "degrees from -1e6 to 1e6");
}

void read_lens(JsonValues& values, const JsonNode& object, Camera& camera) {
  if (const auto fov = JsonValues::member(object, "fov")) {
    camera.vertical_fov_degrees =
        values.number(*fov, {kMinFieldOfView, kMaxFieldOfView}, "degrees from 0.01 to 175");
  }
  if (const auto height = JsonValues::member(object, "orthographic")) {
    camera.orthographic_height =
        values.number(*height, {kOrthographicHeights.min, kOrthographicHeights.max},
                      "the image's height, from 1e-12 to 1e12");
  }
}

}  // namespace relief
