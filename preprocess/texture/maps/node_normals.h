// Normals of samples from the mesh that the points are of.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// Gives a patch's samples the normals that the mesh has there, interpolated between the corners of
/// the triangle nearest to the patch's own surface (find_shown). What a fit makes of the points
/// smooths them; a mesh says what is between its points. Samples over which no triangle faces the
/// patch's side keep their normals. So do all, if the triangles are smaller than those between
/// points half a cell apart: then a fit is a mean over a cell, and one place of it would alias.
///
/// `normals`: unit, of the mesh's points, 0 where there is none; `triangles`: those over the patch,
/// whose normals must have one texel a cell.
void take_mesh_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                       const std::vector<FlatTriangle>& triangles, Patch& patch);

}  // namespace relief
