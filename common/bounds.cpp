#include "common/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relief {

Bounds bounds_of(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) return {};
  Bounds bounds{positions.front(), positions.front()};
  for (const glm::dvec3& p : positions) {
    bounds.min = glm::min(bounds.min, p);
    bounds.max = glm::max(bounds.max, p);
  }
  return bounds;
}

double bounding_radius(const std::vector<glm::dvec3>& positions, const Bounds& bounds) {
  const glm::dvec3 centre = (bounds.min + bounds.max) / 2.0;
  double squared = 0.0;
  for (const glm::dvec3& p : positions)
    squared = std::max(squared, glm::dot(p - centre, p - centre));
  return std::sqrt(squared);
}

}  // namespace relief
