#include "renderer/volume/extent.h"

#include <algorithm>
#include <cmath>

#include "renderer/volume/kernels/volume_nodes.h"

namespace relief {
namespace {

constexpr double kStrayShare = 0.01;

std::vector<glm::dvec3> corners_of(glm::dvec3 low, glm::dvec3 high) {
  std::vector<glm::dvec3> corners;
  for (unsigned c = 0; c < 8; ++c) {
    corners.emplace_back((c & 1U) != 0 ? high.x : low.x, (c & 2U) != 0 ? high.y : low.y,
                         (c & 4U) != 0 ? high.z : low.z);
  }
  return corners;
}

}  // namespace

std::vector<glm::dvec3> extent_of(const ScalarVolume& volume) {
  if (const auto* const grid = std::get_if<CurvilinearGrid>(&volume.placement))
    return grid->positions;
  if (const auto* const points = std::get_if<ScatteredPoints>(&volume.placement))
    return points->positions;
  const VolumeNodes nodes(volume);
  std::vector<glm::dvec3> corners;
  for (const glm::dvec3& corner : corners_of(glm::dvec3(0.0), glm::dvec3(volume.size - 1U)))
    corners.push_back(nodes.position(glm::uvec3(corner)));
  return corners;
}

std::vector<glm::dvec3> extent_of(const GaussianCloud& gaussians) {
  if (gaussians.centres.empty()) return {};
  glm::dvec3 low(0.0);
  glm::dvec3 high(0.0);
  std::vector<float> sorted(gaussians.size());
  const auto strays =
      static_cast<std::ptrdiff_t>(std::floor(kStrayShare * static_cast<double>(sorted.size() - 1)));
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    std::transform(gaussians.centres.begin(), gaussians.centres.end(), sorted.begin(),
                   [axis](const glm::vec3& centre) { return centre[axis]; });
    std::nth_element(sorted.begin(), sorted.begin() + strays, sorted.end());
    low[axis] = static_cast<double>(sorted[static_cast<std::size_t>(strays)]);
    std::nth_element(sorted.begin(), sorted.end() - 1 - strays, sorted.end());
    high[axis] = static_cast<double>(*(sorted.end() - 1 - strays));
  }
  return corners_of(low, high);
}

}  // namespace relief
