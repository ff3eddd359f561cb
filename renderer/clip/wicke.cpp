#include "renderer/clip/wicke.h"

#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

namespace relief {

WickePair wicke_pair(std::span<const PartnerPlane> planes, glm::vec3 offset) {
  std::size_t first = 0;
  std::size_t second = 0;
  float to_first = std::numeric_limits<float>::infinity();
  float to_second = to_first;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const glm::vec3 between = planes[k].centre - offset;
    const float squared = glm::dot(between, between);
    if (squared < to_first) {
      second = first;
      to_second = to_first;
      first = k;
      to_first = squared;
    } else if (squared < to_second) {
      second = k;
      to_second = squared;
    }
  }
  if (planes.size() == 1) return {};
  // The partners see each other's centres: they form a concave edge.
  const glm::vec3 between = planes[second].centre - planes[first].centre;
  const bool is_concave = glm::dot(between, planes[first].normal) > 0.0F &&
                          glm::dot(between, planes[second].normal) < 0.0F;
  const bool is_convex = glm::dot(between, planes[first].normal) < 0.0F &&
                         glm::dot(between, planes[second].normal) > 0.0F;
  const bool intersects =
      (is_concave && !planes[first].edge_is_concave && !planes[second].edge_is_concave) ||
      (is_convex && planes[first].edge_is_concave && planes[second].edge_is_concave);
  return {first, second, intersects};
}

bool wicke_clips(std::span<const ClipLine> lines, std::span<const PartnerPlane> planes,
                 glm::vec3 offset) {
  if (lines.empty()) return false;
  const WickePair pair = wicke_pair(planes, offset);
  const auto clips = [&](std::size_t k) {
    return glm::dot(offset, lines[k].direction) > lines[k].offset;
  };
  return pair.intersects ? clips(pair.first) && clips(pair.second)
                         : clips(pair.first) || clips(pair.second);
}

}  // namespace relief
