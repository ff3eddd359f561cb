#include "preprocess/mesh_fit/fit_to_mesh.h"

#include <cstdint>

#include "preprocess/mesh_fit/fit_heights.h"
#include "preprocess/mesh_fit/overhang_normals.h"
#include "preprocess/mesh_fit/stray_samples.h"
#include "preprocess/texture/maps/map_scales.h"
#include "preprocess/texture/maps/node_normals.h"
#include "preprocess/texture/maps/shown_triangles.h"

namespace relief {
namespace {

/// Of what is shown at kFitTexelsPerCell, what is shown at nodes.
std::vector<std::uint32_t> at_nodes(const std::vector<std::uint32_t>& shown, const Patch& patch) {
  const std::uint64_t columns = map_side(patch.width, kFitTexelsPerCell);
  std::vector<std::uint32_t> nodes;
  nodes.reserve(patch.heights.size());
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i)
      nodes.push_back(shown[kFitTexelsPerCell * (j * columns + i)]);
  }
  return nodes;
}

}  // namespace

void fit_to_mesh(const Points& mesh, const std::vector<glm::vec3>& normals,
                 const TriangleSpheres& spheres, Patch& patch) {
  std::vector<FlatTriangle> triangles = spheres.find_over(patch);
  if (are_finer_than_grid(triangles)) return;
  const std::vector<std::uint32_t> shown = find_shown(patch, kFitTexelsPerCell, triangles);
  fit_heights(triangles, shown, patch);
  const std::vector<std::uint32_t> shown_at_nodes = at_nodes(shown, patch);
  take_mesh_normals(mesh, normals, triangles, shown_at_nodes, patch);
  drop_stray_samples(triangles, shown_at_nodes, spheres, patch);
  take_nearest_normals(mesh, normals, triangles, shown_at_nodes, spheres, patch);
}

}  // namespace relief
