// Meshes that are converted from points spread over them: their own are too few.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/mesh_fit/mesh_sides.h"

namespace relief {

/// A coarse or sharp mesh (is_designed_mesh), whose points were replaced.
struct CoarseScan {
  Points mesh;                   ///< with unit normals; a point on a crease has one for each side
  std::vector<Triangle> welded;  ///< its triangles, with one point a position
  MeshSides sides;               ///< of its triangles, and of the points in place of its own
  bool has_sides = true;         ///< patches keep to them
  bool has_own_normals = false;  ///< the file's
  bool is_oriented = true;       ///< its triangles agree about which side is out
};

/// How many points a mesh with textures shall have: 70,000, or more if the spacing (world units; 0:
/// none) asks for them.
[[nodiscard]] std::size_t least_points(const Points& mesh, double spacing);

/// How many points the mesh of a scan shall have: 35,000, or more if the spacing asks for them. 0
/// if it has as many already, and for bare points.
[[nodiscard]] std::size_t least_points_of_scan(const Points& scan, double spacing);

/// If `points` is a coarse or sharp mesh, takes it and leaves points spread over it in its place.
/// Fails if its triangles have no area that they could lie on, or if the user interrupts.
Result<std::optional<CoarseScan>> take_coarse_mesh(Points& points, double spacing,
                                                   Progress& progress);

}  // namespace relief
