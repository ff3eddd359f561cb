#include "renderer/engines/surfel/surfel_set.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/vector_relational.hpp>

namespace relief::surfel {
namespace {

bool is_finite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vectors at right angles to a normal and each other; n = u x v.
Axes axes_about(glm::vec3 n) {
  const glm::vec3 away = std::abs(n.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 u = glm::normalize(glm::cross(away, n));
  return {u, glm::cross(n, u)};
}

double median_radius(std::vector<float> radii) {
  if (radii.empty()) return 0.0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

}  // namespace

Result<SurfelSet> make_surfel_set(const SplatCloud& cloud, const SurfelSettings& settings,
                                  Progress& progress) {
  if (progress.cancelled()) return interrupted_error();
  SurfelSet set;
  const double scale = settings.scale.value_or(1.0);
  for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
    const glm::dvec3 normal(cloud.normals[k]);
    const double length = glm::length(normal);
    const double radius = scale * cloud.radii[k];
    const bool has_normal = std::isfinite(length) && length > 0.0;
    if (!has_normal || !is_finite(cloud.positions[k]) ||
        !(radius > 0.0 && radius <= kLargestRadius))
      continue;
    set.points.push_back(static_cast<std::uint32_t>(k));
    set.positions.push_back(cloud.positions[k]);
    set.normals.emplace_back(normal / length);
    set.radii.push_back(static_cast<float>(radius));
    const Axes axes = axes_about(set.normals.back());
    set.axes.push_back({axes.u * set.radii.back(), axes.v * set.radii.back()});
    extend(set.bounds, cloud.positions[k] - radius);
    extend(set.bounds, cloud.positions[k] + radius);
  }
  set.bends.assign(set.points.size(), glm::vec3(0.0F));
  set.typical_radius = median_radius(set.radii);
  return set;
}

}  // namespace relief::surfel
