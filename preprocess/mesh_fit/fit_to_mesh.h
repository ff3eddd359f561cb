// Makes a patch show a mesh's triangles instead of its points.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/mesh_fit/mesh_sides.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// Fits a patch that meets its neighbours (ResampleOptions::seams) to the mesh: heights, then
/// normals; samples that lie off the mesh become holes. Nothing changes if the triangles are
/// smaller than those between points half a cell apart (are_finer_than_grid): a mean over a cell is
/// better then. `normals`: unit, of the mesh's points, 0 for missing ones; `spheres`: of the mesh.
void fit_to_mesh(const Points& mesh, const std::vector<glm::vec3>& normals,
                 const TriangleSpheres& spheres, Patch& patch);

/// Fits a patch that meets its neighbours to the triangles of its own side alone: samples that lie
/// over none of them become holes, so that on both sides of a crease patches end less than a cell
/// before it, and make_seams() puts their common border where their planes meet. Nothing changes if
/// the patch lies over none of them. `mesh`: with unit normals, of each side its own.
void cut_to_mesh(const Points& mesh, const MeshSides& sides, std::uint32_t side,
                 const TriangleSpheres& spheres, Patch& patch);

}  // namespace relief
