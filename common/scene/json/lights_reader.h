// The lights in a scene file. Not a public header: it needs nlohmann::json.
#pragma once

#include <vector>

#include "common/scene/json/json_values.h"
#include "common/scene/light.h"

namespace relief {

/// A list of 1 to kMaxLights lights, each with a direction or a position and, if it is not white
/// and of intensity 1, with a colour and an intensity.
std::vector<Light> read_lights(JsonValues& values, const JsonNode& node);

/// [r, g, b], linear, each from 0 to `max`.
glm::vec3 read_linear_colour(JsonValues& values, const JsonNode& node, double max);

}  // namespace relief
