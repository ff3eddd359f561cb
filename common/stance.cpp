#include "common/stance.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relief {

Stance stance_of(glm::dvec3 up) {
  const glm::dvec3 size = glm::abs(up);
  up = glm::normalize(up / std::fmax(size.x, std::fmax(size.y, size.z)));
  glm::dvec3 front(0.0, 0.0, 1.0);
  if (size.y >= size.x && size.y >= size.z) {
    front = {0.0, 0.0, up.y > 0.0 ? 1.0 : -1.0};
  } else if (size.z >= size.x) {
    front = {0.0, up.z > 0.0 ? -1.0 : 1.0, 0.0};
  }
  return {up, glm::normalize(front - glm::dot(front, up) * up), false};
}

}  // namespace relief
