// The scene on which rivals are measured: a bumpy sphere with a checker, known at every place.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "common/image/image.h"
#include "common/scene/camera.h"

namespace relief::experiment {

/// A sphere of radius 1 about the origin with bumps, in the two colours of a checker of cubes that
/// fill space, tinted smoothly.
struct RivalScene {
  double bumps = 0.06;     ///< height of the bumps, in radii
  double frequency = 7.0;  ///< radians of their waves per radius
  double cube = 0.06;      ///< side of the checker's cubes
  glm::vec3 light{0.8F};   ///< of the checker, linear
  glm::vec3 dark{0.25F};
};

/// How points lie on the sphere.
enum class PointPattern : std::uint8_t {
  Even,    ///< a Fibonacci lattice, each point moved by up to a third of a spacing
  Random,  ///< independent of each other
};

/// Distance of the surface from the origin along a direction of length 1.
[[nodiscard]] double radius_along(const RivalScene& scene, glm::dvec3 direction);

/// Linear colour of a place on the surface.
[[nodiscard]] glm::vec3 colour_at(const RivalScene& scene, glm::dvec3 place);

/// Where a ray from `eye`, outside, first meets the surface.
[[nodiscard]] std::optional<glm::dvec3> meet(const RivalScene& scene, glm::dvec3 eye,
                                             glm::dvec3 ray);

/// A scan of `count` points as a binary PLY file with colours, without normals.
[[nodiscard]] std::string scan_ply(const RivalScene& scene, std::size_t count,
                                   PointPattern pattern);

/// What the camera sees, on black: the mean of `samples` rays a pixel, linear, opaque.
[[nodiscard]] Image draw_truth(const RivalScene& scene, const Camera& camera, std::uint32_t width,
                               std::uint32_t height, int samples);

}  // namespace relief::experiment
