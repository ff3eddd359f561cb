#include "renderer/geometry/cells/facing.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {

void NormalBounds::add(glm::vec3 normal) {
  low = glm::min(low, normal);
  high = glm::max(high, normal);
}

bool faces_away(const View& view, const NormalBounds& normals, const glm::dmat3& axes,
                glm::dvec3 centre, double radius) {
  if (normals.empty()) return false;
  const glm::dvec3 low(normals.low);
  const glm::dvec3 high(normals.high);
  const glm::dmat3 grid_from_world = glm::transpose(axes);
  const glm::dvec3 backward = glm::transpose(view.rotation)[2];
  const glm::dvec3 to_eye = grid_from_world * (view.orthographic ? backward : view.eye - centre);
  // The longest normal in the box, times how much nearer to the eye a point of the sphere may be.
  const double reach = view.orthographic ? 0.0 : radius;
  const double longest = glm::length(glm::max(glm::abs(low), glm::abs(high)));
  const glm::dvec3 most = glm::max(low * to_eye, high * to_eye);
  return most.x + most.y + most.z + reach * longest < 0.0;
}

}  // namespace relief
