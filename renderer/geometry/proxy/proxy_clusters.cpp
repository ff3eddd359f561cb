#include "renderer/geometry/proxy/proxy_clusters.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {

std::uint32_t CubeGrid::add(const Cluster& finer) {
  const glm::dvec3 cell = finer.sum.position / (finer.count * spacing_);
  const glm::dvec3 low = glm::floor(cell);
  const double away = glm::distance(cell, low + 0.5);
  const std::uint32_t number = find(low, finer);
  Cluster& cluster = clusters_[number];
  if (cluster.count == 0.0 || away < cluster.away) {
    cluster.away = away;
    cluster.sum.patch = finer.sum.patch;
    cluster.sum.uv = finer.sum.uv;
  }
  cluster.sum.position += finer.sum.position;
  cluster.sum.normal += finer.sum.normal;
  cluster.sum.colour += finer.sum.colour;
  cluster.normals += finer.normals;
  cluster.offsets += finer.offsets;
  cluster.count += finer.count;
  return number;
}

std::uint32_t CubeGrid::find(glm::dvec3 low, const Cluster& finer) {
  const ProxyCube cube{static_cast<std::int64_t>(low.x), static_cast<std::int64_t>(low.y),
                       static_cast<std::int64_t>(low.z)};
  const auto added = static_cast<std::uint32_t>(clusters_.size());
  std::uint32_t number = firsts_.try_emplace(cube, added).first->second;
  std::uint32_t last = kNoMaterial;
  while (number < added && number != kNoMaterial) {
    if (glm::dot(clusters_[number].sum.normal, finer.sum.normal) > 0.0F) return number;
    last = number;
    number = clusters_[number].next;
  }
  if (last != kNoMaterial) clusters_[last].next = added;
  clusters_.emplace_back();
  return added;
}

glm::dvec3 position_of(const Cluster& cluster, double spacing) {
  // Draws it to the mean along directions that the planes leave open.
  constexpr double kToMean = 0.01;
  const glm::dvec3 mean = cluster.sum.position / cluster.count;
  const glm::dmat3 planes = cluster.normals / cluster.count + glm::dmat3(kToMean);
  const glm::dvec3 miss = (cluster.offsets - cluster.normals * mean) / cluster.count;
  const glm::dvec3 step = glm::inverse(planes) * miss;
  const double length = glm::length(step);
  return mean + (length > spacing ? spacing / length : 1.0) * step;
}

}  // namespace relief
