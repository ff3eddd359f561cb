// Whether and where a ray meets a triangle, exactly enough to leave no slits between triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace relief::raytrace {

/// Where a ray from the eye meets a triangle.
struct Hit {
  std::uint32_t triangle = 0;
  double depth = 0.0;       ///< in lengths of the ray's direction
  glm::dvec3 weights{0.0};  ///< barycentric weights of the triangle's corners
};

/// Where the ray from the origin along `direction` meets a triangle, whose number is passed on.
/// Nothing if it is beside or behind, if the triangle is seen edge-on or a corner is no number.
///
/// The test of Woop, Benthin and Wald 2013 (Watertight Ray/Triangle Intersection): in a frame in
/// which the ray is the z axis, by the signs of three differences of products. Compared instead of
/// subtracted, these signs are right or 0, as rounding keeps the order of two products; and 0
/// counts for either side. So a ray through an edge or a corner meets all triangles around it.
[[nodiscard]] std::optional<Hit> meet_triangle(std::uint32_t number,
                                               const std::array<glm::dvec3, 3>& corners,
                                               glm::dvec3 direction);

}  // namespace relief::raytrace
