// Points spread over the triangles of a textured mesh.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// Points on a surface with what the mesh says there. All vectors have the same length.
struct SurfacePoints {
  std::vector<glm::dvec3> positions;  ///< world
  std::vector<glm::vec3> normals;     ///< unit, interpolated between the vertices'
  std::vector<glm::vec2> texcoords;   ///< interpolated within the triangle: exact at seams; 0
                                      ///< where the mesh has none

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// The size of a textured mesh.
struct SurfaceArea {
  double world = 0.0;    ///< world units squared
  double texture = 0.0;  ///< in squares [0, 1]^2 of texture coordinates; overlaps count each time
};

/// Adds up the triangles.
[[nodiscard]] SurfaceArea area_of(const Points& mesh);

/// `count` points, each for the same share of the area: as many in a triangle as its area earns,
/// placed by the R2 sequence (Roberts 2018, "The unreasonable effectiveness of quasirandom
/// sequences"). The mean of a function over them is the function's mean over the surface, with an
/// error that falls almost as 1 / count within large triangles. `mesh` needs unit normals and an
/// area above 0. Does not depend on the number of threads.
[[nodiscard]] SurfacePoints spread_over_triangles(const Points& mesh, std::size_t count);

}  // namespace relief
