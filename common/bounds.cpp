#include "common/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relief {

void extend(Bounds& box, glm::dvec3 point) {
  box = box.empty() ? Bounds{point, point}
                    : Bounds{glm::min(box.min, point), glm::max(box.max, point)};
}

Bounds bounds_of(const std::vector<glm::dvec3>& positions) {
  Bounds bounds;
  for (const glm::dvec3& p : positions) extend(bounds, p);
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
