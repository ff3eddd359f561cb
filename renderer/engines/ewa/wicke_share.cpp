#include "renderer/engines/ewa/wicke_share.h"

#include <glm/geometric.hpp>

#include "renderer/clip/wicke.h"

namespace relief::ewa {

KeptShare wicke_share(const WickeSplat& splat, std::span<const ImageLine> lines, const View& view,
                      glm::dvec2 pixel, glm::dvec2 offset) {
  if (lines.empty()) return {};
  const glm::dvec2 window(pixel.x, view.height - pixel.y);
  const glm::dvec3 through = ray_through(view, window);
  const glm::dvec3 start = ray_start(view, window) - (splat.position - view.eye);
  const double depth = -glm::dot(splat.normal, start) / glm::dot(splat.normal, through);
  const WickePair pair = wicke_pair(splat.planes, glm::vec3(start + depth * through));
  const ImageLine& first = lines[pair.first];
  const ImageLine& second = lines[pair.second];
  const KeptShare of_first{first.kept(offset), glm::dvec2(first.beyond)};
  const KeptShare of_second{second.kept(offset), glm::dvec2(second.beyond)};
  return (of_first.share < of_second.share) == pair.intersects ? of_second : of_first;
}

}  // namespace relief::ewa
