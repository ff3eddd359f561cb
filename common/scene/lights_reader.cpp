#include "common/scene/lights_reader.h"

#include "common/scene/vector_values.h"

namespace relief {
namespace {

Light read_light(JsonValues& values, const JsonPlace& place) {
  Light light;
  if (!values.object(place, {"direction", "position", "colour", "intensity"})) return light;
  const auto direction = JsonValues::member(place, "direction");
  const auto position = JsonValues::member(place, "position");
  if (direction.has_value() == position.has_value()) {
    values.refuse(place.path,
                  fmt::format("expected either a direction, toward the light, or a position; "
                              "found {}",
                              direction ? "both" : "neither"));
    return light;
  }
  light.kind = position ? LightKind::Point : LightKind::Directional;
  light.place = position ? read_vector(values, *position) : read_direction(values, *direction);
  if (const auto found = JsonValues::member(place, "colour"))
    light.colour = read_linear_colour(values, *found, 1.0);
  if (const auto found = JsonValues::member(place, "intensity")) {
    const double most = position ? kMaxPointLight : kMaxLight;
    const std::string expected = fmt::format("a number from 0 to {:g}", most);
    light.colour *= static_cast<float>(values.number(*found, {0.0, most}, expected));
  }
  return light;
}

}  // namespace

std::vector<Light> read_lights(JsonValues& values, const JsonPlace& place) {
  std::vector<Light> lights;
  for (const JsonPlace& light : values.elements(place, kMaxLights, "lights"))
    lights.push_back(read_light(values, light));
  return lights;
}

glm::vec3 read_linear_colour(JsonValues& values, const JsonPlace& place, double most) {
  const std::string expected = fmt::format("[r, g, b], linear, each from 0 to {:g}", most);
  const auto n = values.numbers(place, {3, 3}, {0.0, most}, expected);
  return n.empty() ? glm::vec3(0.0F) : glm::vec3(n[0], n[1], n[2]);
}

}  // namespace relief
