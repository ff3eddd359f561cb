#include "common/scene/json/lights_reader.h"

#include "common/scene/json/vector_values.h"

namespace relief {
namespace {

Light read_light(JsonValues& values, const JsonNode& node) {
  Light light;
  if (!values.object(node, {"direction", "position", "colour", "intensity"})) return light;
  const auto direction = JsonValues::member(node, "direction");
  const auto position = JsonValues::member(node, "position");
  if (direction.has_value() == position.has_value()) {
    values.refuse(node.path,
                  fmt::format("expected either a direction, toward the light, or a position; "
                              "found {}",
                              direction ? "both" : "neither"));
    return light;
  }
  light.kind = position ? LightKind::Point : LightKind::Directional;
  light.position = position ? read_vector(values, *position) : read_direction(values, *direction);
  if (const auto found = JsonValues::member(node, "colour"))
    light.colour = read_linear_colour(values, *found, 1.0);
  if (const auto found = JsonValues::member(node, "intensity")) {
    const double max = position ? kMaxPointLight : kMaxLight;
    const std::string expected = fmt::format("a number from 0 to {:g}", max);
    light.colour *= static_cast<float>(values.number(*found, {0.0, max}, expected));
  }
  return light;
}

}  // namespace

std::vector<Light> read_lights(JsonValues& values, const JsonNode& node) {
  std::vector<Light> lights;
  for (const JsonNode& light : values.elements(node, kMaxLights, "lights"))
    lights.push_back(read_light(values, light));
  return lights;
}

glm::vec3 read_linear_colour(JsonValues& values, const JsonNode& node, double max) {
  const std::string expected = fmt::format("[r, g, b], linear, each from 0 to {:g}", max);
  const auto n = values.numbers(node, {3, 3}, {0.0, max}, expected);
  return n.empty() ? glm::vec3(0.0F) : glm::vec3(n[0], n[1], n[2]);
}

}  // namespace relief
