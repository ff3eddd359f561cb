#include "renderer/engines/ewa/wicke_share.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "renderer/clip/wicke.h"

namespace relief::ewa {

double wicke_share(const WickeSplat& splat, std::span<const ImageLine> lines, const View& view,
                   glm::dvec2 pixel, glm::dvec2 offset) {
  if (lines.empty()) return 1.0;
  const glm::dvec2 window(pixel.x, view.height - pixel.y);
  const glm::dvec3 through = ray_through(view, window);
  const glm::dvec3 start = ray_start(view, window) - (splat.position - view.eye);
  const double depth = -glm::dot(splat.normal, start) / glm::dot(splat.normal, through);
  const WickePair pair = wicke_pair(splat.planes, glm::vec3(start + depth * through));
  const double first = lines[pair.first].kept(offset);
  const double second = lines[pair.second].kept(offset);
  return pair.intersects ? std::max(first, second) : std::min(first, second);
}

}  // namespace relief::ewa
