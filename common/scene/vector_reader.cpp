#include "common/scene/vector_reader.h"

#include <glm/geometric.hpp>
#include <string>

#include "common/scene/scene.h"

namespace relief {
namespace {

constexpr NumberRange kCoordinates{-kMaxSceneCoordinate, kMaxSceneCoordinate};
constexpr double kShortestDirection = 1e-12;

}  // namespace

std::filesystem::path read_path(JsonValues& values, const JsonPlace& place,
                                const std::filesystem::path& folder, std::string_view expected) {
  const std::string name = values.text(place, expected);
  // With a zero byte it would be another file's name to the operating system.
  if (name.find('\0') != std::string::npos) values.refuse_value(place, expected);
  return folder / name;
}

glm::dvec3 read_vector(JsonValues& values, const JsonPlace& place) {
  const auto n = values.numbers(place, {3, 3}, kCoordinates, "[x, y, z], three numbers");
  return n.empty() ? glm::dvec3(0.0) : glm::dvec3(n[0], n[1], n[2]);
}

glm::dvec3 read_direction(JsonValues& values, const JsonPlace& place) {
  const glm::dvec3 v = read_vector(values, place);
  const double length = glm::length(v);
  if (length > kShortestDirection) return v / length;
  values.refuse_value(place, "[x, y, z] longer than 0");
  return {0.0, 1.0, 0.0};
}

double read_angle(JsonValues& values, const JsonPlace& place) {
  return values.number(place, kAngles, "degrees from -1e6 to 1e6");
}

}  // namespace relief
