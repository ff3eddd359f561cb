// Spreads points over the triangles of a textured mesh.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/points.h"

namespace relief {

/// Points on a surface with the mesh's attributes. All vectors have equal length.
struct SurfacePoints {
  std::vector<glm::dvec3> positions;  ///< world
  std::vector<glm::vec3> normals;     ///< unit, interpolated between vertices
  std::vector<glm::vec2>
      texcoords;  ///< interpolated within the triangle, so exact at seams; 0 if the mesh has none

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// The size of a textured mesh.
struct SurfaceArea {
  double world = 0.0;    ///< world units squared
  double texture = 0.0;  ///< in squares [0, 1]^2 of texture coordinates; overlaps count each time
};

/// Returns the area of a mesh's triangles.
[[nodiscard]] SurfaceArea area_of(const Points& mesh);

/// Returns `count` points, each for an equal share of the area: their number in a triangle is
/// proportional to its area, and the R2 sequence places them (Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences"). The mean of a function over them approximates its mean
/// over the surface, with an error that falls almost as 1 / count within large triangles. `mesh`
/// needs unit normals and an area above 0. Does not depend on the number of threads.
[[nodiscard]] SurfacePoints spread_over_triangles(const Points& mesh, std::size_t count);

}  // namespace relief
