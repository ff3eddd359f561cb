#include "renderer/geometry/meshes/mesh_of_points.h"

#include "common/image/srgb.h"
#include "common/mesh/creases.h"
#include "common/mesh/mesh_normals.h"
#include "common/mesh/mesh_tangents.h"
#include "common/mesh/sharp_mesh.h"

namespace relief {
namespace {

TriangleMesh smooth_mesh(const Points& points) {
  TriangleMesh mesh;
  mesh.positions = points.positions;
  mesh.triangles = points.triangles;
  mesh.normals = vertex_normals(points);
  mesh.colours.reserve(points.colours.size());
  for (const glm::u8vec3& colour : points.colours)
    mesh.colours.emplace_back(linear_from_srgb8(colour), 1.0F);
  if (points.triangle_materials.empty()) return mesh;
  mesh.textures = points.materials;
  mesh.triangle_textures = points.triangle_materials;
  mesh.texcoords.resize(points.triangles.size());
  if (points.texcoords.empty()) return mesh;
  for (std::size_t t = 0; t < points.triangles.size(); ++t)
    mesh.texcoords[t] = texcoords_of(points, t);
  if (has_normal_maps(points)) mesh.tangents = tangents_of(points, mesh.normals);
  return mesh;
}

}  // namespace

TriangleMesh mesh_of_points(const Points& points) {
  if (!points.normals.empty() || !is_designed_mesh(points)) return smooth_mesh(points);
  Points split = points;
  split_at_creases(split);
  return smooth_mesh(split);
}

}  // namespace relief
