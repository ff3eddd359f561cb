// Takes the normals of samples from the mesh.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// Sets the normals of a patch's samples to the mesh's normals, interpolated between the corners of
/// the triangle nearest to the patch's surface (find_shown). Fitted normals are smoother, but a
/// mesh defines the surface between its points. Samples under no triangle that faces the patch's
/// side keep their normals. All keep them if the triangles are smaller than those between points
/// half a cell apart: a fit is then a mean over a cell, and a single position of the mesh would
/// alias.
///
/// `normals`: unit, of the mesh's points, 0 for missing ones. `triangles`: those over the patch.
/// The patch's normals must have one texel per cell.
void take_mesh_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                       const std::vector<FlatTriangle>& triangles, Patch& patch);

/// The same whatever the triangles' size. `shown`: by node which of them the patch's surface shows.
void take_mesh_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                       const std::vector<FlatTriangle>& triangles,
                       const std::vector<std::uint32_t>& shown, Patch& patch);

}  // namespace relief
