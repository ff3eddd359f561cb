// Planes through points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace relief {

/// The plane of some points by principal component analysis.
struct PlaneFit {
  glm::dvec3 middle{0.0};  ///< their mean, on the plane
  glm::dvec3 normal{0.0};  ///< unit, sign arbitrary
  double variation = 0.0;  ///< smallest eigenvalue over the sum of all
  double rms = 0.0;        ///< distance of the points to the plane
};

/// Fits a plane to one point and others.
[[nodiscard]] PlaneFit fit_plane(const std::vector<glm::dvec3>& positions, std::size_t one,
                                 std::span<const std::uint32_t> others);

}  // namespace relief
