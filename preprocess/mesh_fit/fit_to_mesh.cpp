#include "preprocess/mesh_fit/fit_to_mesh.h"

#include <cmath>
#include <cstdint>
#include <utility>

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

/// Leaves samples only where nodes show a triangle, at its height; false if none does.
bool cut_to_shown(const std::vector<FlatTriangle>& triangles,
                  const std::vector<std::uint32_t>& shown, Patch& patch) {
  std::vector<std::int32_t> kept(patch.heights.size(), kHole);
  bool any = false;
  for (std::size_t node = 0; node < kept.size(); ++node) {
    if (patch.heights[node] == kHole || shown[node] == kNoTriangle) continue;
    const glm::dvec2 at(node % patch.width, node / patch.width);
    const double height = triangles[shown[node]].height_at(at) * patch.spacing;
    kept[node] = static_cast<std::int32_t>(std::lround(height / patch.height_step));
    any = true;
  }
  if (any) patch.heights = std::move(kept);
  return any;
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

void cut_to_mesh(const Points& mesh, const MeshSides& sides, std::uint32_t side,
                 const TriangleSpheres& spheres, Patch& patch) {
  std::vector<FlatTriangle> triangles = spheres.find_over(patch);
  std::erase_if(triangles, [&](const FlatTriangle& t) {
    const std::uint32_t other = sides.of_triangles[t.index];
    return t.twice_area <= 0.0 || (other != side && other != kAnySide);
  });
  const std::vector<std::uint32_t> shown = find_shown(patch, kFitTexelsPerCell, triangles);
  const std::vector<std::uint32_t> shown_at_nodes = at_nodes(shown, patch);
  if (!cut_to_shown(triangles, shown_at_nodes, patch)) return;
  fit_heights(triangles, shown, patch);
  take_mesh_normals(mesh, mesh.normals, triangles, shown_at_nodes, patch);
}

}  // namespace relief
