#include "common/volume/spacing.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {
namespace {

double spacing_of(const RegularGrid& grid) {
  return std::cbrt(std::abs(glm::determinant(grid.step)));
}

double spacing_of(const RectilinearGrid& grid) {
  double product = std::abs(glm::determinant(grid.axes));
  for (const auto& c : grid.coordinates) {
    if (c.size() > 1) product *= (c.back() - c.front()) / static_cast<double>(c.size() - 1);
  }
  return std::cbrt(product);
}

/// Of positions without order: as if they filled their box evenly.
double spacing_in_box(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) return 0.0;
  glm::dvec3 low = positions.front();
  glm::dvec3 high = low;
  for (const glm::dvec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 box = high - low;
  return std::cbrt(box.x * box.y * box.z / static_cast<double>(positions.size()));
}

double spacing_of(const CurvilinearGrid& grid) {
  return spacing_in_box(grid.positions);
}
double spacing_of(const ScatteredPoints& points) {
  if (points.spacings.empty()) return spacing_in_box(points.positions);
  double sum = 0.0;
  for (const float spacing : points.spacings) sum += static_cast<double>(spacing);
  return sum / static_cast<double>(points.spacings.size());
}

}  // namespace

double mean_spacing(const ScalarVolume& volume) {
  const double spacing =
      std::visit([](const auto& placement) { return spacing_of(placement); }, volume.placement);
  return spacing > 0.0 && std::isfinite(spacing) ? spacing : 1.0;
}

}  // namespace relief
