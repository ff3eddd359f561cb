#include "preprocess/raster/geo_frame.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace relief {

GeoFrame frame_of(const GeoGrid& grid, double columns, double rows) {
  GeoFrame frame;
  if (!grid.in_degrees) {
    frame.cell = {grid.dx, grid.dy};
    return frame;
  }
  frame.centre = {grid.x + 0.5 * (columns - 1.0) * grid.dx, grid.y - 0.5 * (rows - 1.0) * grid.dy};
  const double latitude = glm::radians(frame.centre.y);
  const double f = grid.inverse_flattening > 0.0 ? 1.0 / grid.inverse_flattening : 0.0;
  const double e2 = f * (2.0 - f);
  const double w2 = 1.0 - e2 * std::sin(latitude) * std::sin(latitude);
  const double normal = grid.semi_major / std::sqrt(w2);
  const double meridian = normal * (1.0 - e2) / w2;
  frame.factor = {glm::radians(normal * std::cos(latitude)), glm::radians(meridian)};
  frame.cell = frame.factor * glm::dvec2(grid.dx, grid.dy);
  const double stretch = frame.cell.y / frame.cell.x;
  if (std::abs(stretch - 1.0) > kLargestStretch) return frame;
  frame.stretch = stretch;
  frame.factor.x *= stretch;
  frame.cell.x = frame.cell.y;
  return frame;
}

}  // namespace relief
