// Surfaces that are known, sampled as scans are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tests/renderer/surfels/disc_coverage.h"

namespace relief::test {

enum class Shape : std::uint8_t { Plane, Sphere, Torus };

/// How points lie on a surface.
enum class Sampling : std::uint8_t {
  Random,     ///< each anywhere
  BlueNoise,  ///< no two near each other
  Jittered,   ///< on a grid, moved by up to half its spacing
  Crossings   ///< where the lines of a cubic grid meet the surface: the vertices of marching cubes
};

inline constexpr Shape kShapes[] = {Shape::Plane, Shape::Sphere, Shape::Torus};
inline constexpr Sampling kSamplings[] = {Sampling::Random, Sampling::BlueNoise, Sampling::Jittered,
                                          Sampling::Crossings};
[[nodiscard]] std::string name_of(Shape shape);
[[nodiscard]] std::string name_of(Sampling sampling);

/// Points with unit outward normals. The plane is larger than the square from -1 to 1 by a tenth,
/// so that nothing of that square is at a border; the sphere has radius 1, the torus 1 and 0.4.
struct SampledSurface {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
};

/// About so many points.
[[nodiscard]] SampledSurface sample_surface(Shape shape, Sampling sampling, std::size_t points,
                                            std::uint32_t seed);

/// The surface itself, evenly; of the plane the square from -1 to 1.
[[nodiscard]] SurfaceSamples surface_truth(Shape shape, std::size_t samples);

}  // namespace relief::test
