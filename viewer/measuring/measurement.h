// Measurements between points of the surface: what they are worth, and how that is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/measuring/surface_pick.h"

namespace relief {

enum class MeasurementKind : std::uint8_t {
  Point,     ///< 1 point: its coordinates
  Distance,  ///< 2 points
  Polyline,  ///< 2 points or more
  Height,    ///< 2 points: from the first up to the second
  Angle      ///< 3 points: at the second, between the directions to the others
};

/// Points that were picked, and what is measured of them. Lengths are in the scan's unit.
struct Measurement {
  MeasurementKind kind = MeasurementKind::Point;
  std::string name;  ///< the user's; may be empty
  std::vector<SurfacePoint> points;
};

/// Returns the name of a kind, as files have it: point, distance, polyline, height, angle.
[[nodiscard]] std::string_view name_of(MeasurementKind kind);

/// Returns how many points a kind has; the fewest, of a polyline.
[[nodiscard]] std::size_t points_of(MeasurementKind kind);

/// Returns whether a measurement has all its points. What follows is of such ones.
[[nodiscard]] bool is_complete(const Measurement& measurement);

/// A number that was measured.
struct MeasuredValue {
  std::string_view name;  ///< as files have it, such as horizontal_length
  double value = 0.0;     ///< degrees if the name ends so, else the scan's unit
};

/// Returns what a measurement is worth: of a point x, y, z; of a distance and a polyline length,
/// horizontal_length and height; of a height that and horizontal_length; of an angle
/// angle_degrees, 0 where two of its points are one. `up`: the model's up direction, of any length
/// but 0; heights are along it, horizontal lengths at a right angle to it.
[[nodiscard]] std::vector<MeasuredValue> values_of(const Measurement& measurement, glm::dvec3 up);

/// Writes a length or coordinate with as many digits after the point as suit the model: a
/// thousandth of its spacing, rounded to a power of ten, but no more than doubles of that size
/// hold. So UTM coordinates of a scan with a point each metre have millimetres.
[[nodiscard]] std::string format_length(double length, double spacing);

/// Writes a position as "x, y, z", each as format_length() does.
[[nodiscard]] std::string format_position(glm::dvec3 position, double spacing);

/// Returns the text of a measurement in a view: its first value, of a point the position. Angles
/// have hundredths of a degree.
[[nodiscard]] std::string label_of(const Measurement& measurement, glm::dvec3 up, double spacing);

/// Returns what is copied of a measurement: that value with as many digits as bring it back to the
/// bit, of a point "x, y, z".
[[nodiscard]] std::string copied_text(const Measurement& measurement, glm::dvec3 up);

/// Returns where its label belongs (world): at a point, in the middle of the way along a distance,
/// height or polyline, at the middle point of an angle.
[[nodiscard]] glm::dvec3 label_anchor(const Measurement& measurement);

}  // namespace relief
