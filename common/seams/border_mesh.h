// The borders of all patches of a model: their vertices, and which edges between them have a
// triangle.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
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
  /// By find_planes(): normal of the plane through the patch's samples about it, world, unit:
  /// unlike theirs it knows one side of a crease alone.
  glm::dvec3 plane_normal{0.0};
  /// Of those samples, radians per spacing; infinite if they are too few.
  double bend = std::numeric_limits<double>::infinity();
  std::uint32_t patch = 0;
  std::uint32_t node = 0;   ///< j * width + i
  bool beside_hole = true;  ///< or at the grid's end: not all eight nodes about it are samples
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
  /// By find_parts(): for each vertex the first that cells of its patch connect it to. Stitching
  /// tells islands by it.
  std::vector<std::uint32_t> parts;
};

/// `cells`: those of each patch.
[[nodiscard]] BorderMesh find_borders(std::span<const Patch> patches,
                                      std::span<const CellTriangles> cells);

/// Fits planes to the samples about all vertices. Creases are where they differ.
void find_planes(std::span<const Patch> patches, BorderMesh& mesh);

}  // namespace relief
