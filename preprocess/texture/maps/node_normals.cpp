#include "preprocess/texture/maps/node_normals.h"

#include <cassert>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/octahedral.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "preprocess/texture/maps/shown_triangles.h"

namespace relief {

void take_mesh_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                       const std::vector<FlatTriangle>& triangles,
                       const std::vector<std::uint32_t>& shown, Patch& patch) {
  assert(patch.normals.texels.size() == patch.heights.size() && "one normal a node");
  const std::vector<std::uint8_t> samples = sample_mask(patch);
  const glm::dmat3 to_patch = glm::transpose(patch.axes);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (samples[k] == 0 || shown[k] == kNoTriangle) continue;
    const FlatTriangle& triangle = triangles[shown[k]];
    if (triangle.twice_area <= 0.0) continue;
    const glm::dvec3 weights = triangle.weights_at({k % patch.width, k / patch.width});
    glm::dvec3 sum(0.0);
    for (std::size_t c = 0; c < 3; ++c) {
      sum += weights[static_cast<glm::length_t>(c)] *
             glm::dvec3(normals[mesh.triangles[triangle.index][c]]);
    }
    // Opposed normals cancel out to rounding.
    if (glm::length(sum) < 1e-6) continue;
    patch.normals.texels[k] = snorm16_from_unit(glm::vec3(to_patch * glm::normalize(sum)));
  }
  continue_over_holes(patch.normals, samples);
}

void take_mesh_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                       const std::vector<FlatTriangle>& triangles, Patch& patch) {
  if (are_finer_than_grid(triangles)) return;
  take_mesh_normals(mesh, normals, triangles, find_shown(patch, 1, triangles), patch);
}

}  // namespace relief
