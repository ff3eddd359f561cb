// The borders of all patches of a model: their vertices, and which edges between them have a
// triangle.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/patch.h"
#include "common/seams/cell_triangles.h"

namespace relief {

/// A sample at the border of its patch.
struct BorderVertex {
  glm::dvec3 position{0.0};  ///< world
  glm::dvec3 normal{0.0};    ///< world, unit, outward
  double spacing = 1.0;      ///< of its patch
  double turn = 0.0;         ///< largest change of the normal to a sample beside it in its patch
  std::uint32_t patch = 0;
  std::uint32_t node = 0;  ///< j * width + i
};

/// An edge from one border vertex to another, with a triangle on its left, seen from outside.
struct BorderEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  glm::dvec3 normal{0.0};  ///< of that triangle, unit
};

struct BorderMesh {
  std::vector<BorderVertex> vertices;  ///< by patch, then by node
  /// Of all triangles of cells; an edge whose opposite is missing is at the border.
  std::vector<BorderEdge> edges;
};

/// `cells`: those of each patch.
[[nodiscard]] BorderMesh find_borders(std::span<const Patch> patches,
                                      std::span<const CellTriangles> cells);

}  // namespace relief
