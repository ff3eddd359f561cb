// Normals of samples that lie beside all triangles of their patch's side.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"

namespace relief {

/// Gives samples that overhang a crease the normal of the mesh's nearest position, which knows both
/// sides; those of their points know one. `normals`: unit, of the mesh's points. `triangles`: those
/// over the patch; `shown`: by node which of them its surface shows; `spheres`: of the mesh.
void take_nearest_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                          const std::vector<FlatTriangle>& triangles,
                          std::span<const std::uint32_t> shown, const TriangleSpheres& spheres,
                          Patch& patch);

}  // namespace relief
