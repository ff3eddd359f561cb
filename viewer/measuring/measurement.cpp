#include "viewer/measuring/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace relief {
namespace {

/// The way along all points, and what of it is level.
struct Lengths {
  double whole = 0.0;
  double horizontal = 0.0;
};

Lengths lengths_of(const std::vector<SurfacePoint>& points, glm::dvec3 up) {
  Lengths lengths;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const glm::dvec3 step = points[k].position - points[k - 1].position;
    lengths.whole += glm::length(step);
    lengths.horizontal += glm::length(step - glm::dot(step, up) * up);
  }
  return lengths;
}

double height_between(const std::vector<SurfacePoint>& points, glm::dvec3 up) {
  return glm::dot(points.back().position - points.front().position, up);
}

/// By the arc tangent, which is exact for small and for straight angles, too.
double angle_at_second(const std::vector<SurfacePoint>& points) {
  const glm::dvec3 a = points[0].position - points[1].position;
  const glm::dvec3 b = points[2].position - points[1].position;
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace

std::string_view name_of(MeasurementKind kind) {
  switch (kind) {
    case MeasurementKind::Point:
      return "point";
    case MeasurementKind::Distance:
      return "distance";
    case MeasurementKind::Polyline:
      return "polyline";
    case MeasurementKind::Height:
      return "height";
    case MeasurementKind::Angle:
      return "angle";
  }
  return {};
}

std::size_t points_of(MeasurementKind kind) {
  switch (kind) {
    case MeasurementKind::Point:
      return 1;
    case MeasurementKind::Angle:
      return 3;
    default:
      return 2;
  }
}

bool is_complete(const Measurement& measurement) {
  const std::size_t count = points_of(measurement.kind);
  return measurement.kind == MeasurementKind::Polyline ? measurement.points.size() >= count
                                                       : measurement.points.size() == count;
}

std::vector<MeasuredValue> values_of(const Measurement& measurement, glm::dvec3 up) {
  assert(is_complete(measurement) && "measured once all points are there");
  const std::vector<SurfacePoint>& points = measurement.points;
  const glm::dvec3 upward = glm::normalize(up);
  switch (measurement.kind) {
    case MeasurementKind::Point: {
      const glm::dvec3 p = points.front().position;
      return {{"x", p.x}, {"y", p.y}, {"z", p.z}};
    }
    case MeasurementKind::Distance:
    case MeasurementKind::Polyline: {
      const Lengths lengths = lengths_of(points, upward);
      return {{"length", lengths.whole},
              {"horizontal_length", lengths.horizontal},
              {"height", height_between(points, upward)}};
    }
    case MeasurementKind::Height:
      return {{"height", height_between(points, upward)},
              {"horizontal_length", lengths_of(points, upward).horizontal}};
    case MeasurementKind::Angle:
      return {{"angle_degrees", angle_at_second(points)}};
  }
  return {};
}

std::string format_length(double length, double spacing) {
  constexpr double kThousandth = 3.0;
  const double wanted = spacing > 0.0 ? kThousandth - std::ceil(std::log10(spacing)) : kThousandth;
  const double before = length == 0.0 ? 0.0 : std::floor(std::log10(std::abs(length))) + 1.0;
  const double held = std::numeric_limits<double>::digits10 - std::max(before, 0.0);
  const auto decimals = static_cast<int>(std::clamp(std::min(wanted, held), 0.0, 15.0));
  // What rounds to 0 has no sign.
  const double unit = std::pow(10.0, -decimals);
  return fmt::format("{:.{}f}", std::abs(length) < 0.5 * unit ? 0.0 : length, decimals);
}

std::string format_position(glm::dvec3 position, double spacing) {
  return fmt::format("{}, {}, {}", format_length(position.x, spacing),
                     format_length(position.y, spacing), format_length(position.z, spacing));
}

std::string label_of(const Measurement& measurement, glm::dvec3 up, double spacing) {
  if (measurement.kind == MeasurementKind::Point)
    return format_position(measurement.points.front().position, spacing);
  const double value = values_of(measurement, up).front().value;
  if (measurement.kind == MeasurementKind::Angle) return fmt::format("{:.2f}°", value);
  return format_length(value, spacing);
}

std::string copied_text(const Measurement& measurement, glm::dvec3 up) {
  if (measurement.kind != MeasurementKind::Point)
    return fmt::format("{}", values_of(measurement, up).front().value);
  const glm::dvec3 at = measurement.points.front().position;
  return fmt::format("{}, {}, {}", at.x, at.y, at.z);
}

glm::dvec3 label_anchor(const Measurement& measurement) {
  assert(is_complete(measurement) && "labelled once all points are there");
  const std::vector<SurfacePoint>& points = measurement.points;
  if (measurement.kind == MeasurementKind::Point) return points.front().position;
  if (measurement.kind == MeasurementKind::Angle) return points[1].position;
  double way = 0.5 * lengths_of(points, glm::dvec3(0.0)).whole;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const glm::dvec3 step = points[k].position - points[k - 1].position;
    const double length = glm::length(step);
    if (length > 0.0 && way <= length) return points[k - 1].position + way / length * step;
    way -= length;
  }
  return points.back().position;
}

}  // namespace relief
