// Meshes of OpenMesh: in as Points with triangles, out as the surface of patches. Header only: a
// program that includes it has OpenMesh itself, and links relief::preprocess and relief::renderer.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/read_points.h"
#include "renderer/geometry/meshes/points_of_patches.h"

namespace relief {
namespace openmesh_adapter {

/// Colours of OpenMesh are from 0 to 1 if they are real numbers, from 0 to 255 otherwise.
template <class Channel>
std::uint8_t byte_of(Channel value) {
  if constexpr (std::is_floating_point_v<Channel>) {
    if (!(value > Channel{0})) return 0;
    return value < Channel{1} ? static_cast<std::uint8_t>(value * 255 + Channel(0.5)) : 255;
  } else {
    return static_cast<std::uint8_t>(value);
  }
}

template <class Color>
Color color_of(glm::u8vec3 colour) {
  using Channel = typename OpenMesh::vector_traits<Color>::value_type;
  constexpr bool is_real = std::is_floating_point_v<Channel>;
  Color color;
  color.vectorize(is_real ? Channel(1) : Channel(255));  // opaque, if there is a fourth channel
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = static_cast<Channel>(colour[static_cast<glm::length_t>(c)]);
    color[c] = is_real ? static_cast<Channel>(value / 255) : value;
  }
  return color;
}

template <class Vector, class From>
Vector vector_of(From v) {
  using Real = typename OpenMesh::vector_traits<Vector>::value_type;
  return Vector(static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z));
}

}  // namespace openmesh_adapter

/// Returns a mesh's vertices and faces as convert() takes them: deleted elements left out, polygons
/// split into fans, equal positions merged (clean_points). Normals and colours (sRGB) of vertices
/// are taken if the mesh has them; normals that are 0 are derived from the faces. Texture
/// coordinates are not taken. `Mesh`: any of OpenMesh's with an array kernel. It has fewer than
/// 2^32 - 1 vertices.
template <class Mesh>
[[nodiscard]] Points points_of_openmesh(const Mesh& mesh) {
  Points points;
  std::vector<std::uint32_t> number(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    number[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(points.size());
    const auto& p = mesh.point(v);
    points.positions.emplace_back(p[0], p[1], p[2]);
    if (mesh.has_vertex_normals()) {
      const auto& n = mesh.normal(v);
      points.normals.emplace_back(n[0], n[1], n[2]);
    }
    if (mesh.has_vertex_colors()) {
      const auto& c = mesh.color(v);
      points.colours.emplace_back(openmesh_adapter::byte_of(c[0]), openmesh_adapter::byte_of(c[1]),
                                  openmesh_adapter::byte_of(c[2]));
    }
  }
  std::vector<std::uint32_t> corners;
  for (const auto f : mesh.faces()) {
    corners.clear();
    for (auto v = mesh.cfv_iter(f); v.is_valid(); ++v)
      corners.push_back(number[static_cast<std::size_t>(v->idx())]);
    append_polygon(corners, points.triangles);
  }
  return clean_points(std::move(points)).points;
}

/// Returns points and triangles as a mesh, with the normals and sRGB colours that they have. A
/// triangle that OpenMesh refuses, because it has no place in a manifold with those before it, gets
/// vertices of its own, as OpenMesh's readers do. Fails if there are more triangles than OpenMesh
/// can count.
template <class Mesh = OpenMesh::TriMesh>
[[nodiscard]] Result<Mesh> openmesh_of_points(const Points& points) {
  using Point = typename Mesh::Point;
  using Normal = typename Mesh::Normal;
  // Handles are int, and separate triangles have six halfedges each.
  constexpr std::size_t kMostVertices = INT32_MAX;
  constexpr std::size_t kMostTriangles = INT32_MAX / 6;
  if (points.size() > kMostVertices || points.triangles.size() > kMostTriangles) {
    return make_error(
        "the surface has {} vertices and {} triangles, but a mesh of OpenMesh has at most {} and "
        "{}; convert again with a larger spacing",
        points.size(), points.triangles.size(), kMostVertices, kMostTriangles);
  }
  Mesh mesh;
  if (!points.normals.empty()) mesh.request_vertex_normals();
  if (!points.colours.empty()) mesh.request_vertex_colors();
  const auto add_vertex = [&](std::uint32_t k) {
    const auto v = mesh.add_vertex(openmesh_adapter::vector_of<Point>(points.positions[k]));
    if (!points.normals.empty())
      mesh.set_normal(v, openmesh_adapter::vector_of<Normal>(points.normals[k]));
    if (!points.colours.empty())
      mesh.set_color(v, openmesh_adapter::color_of<typename Mesh::Color>(points.colours[k]));
    return typename Mesh::VertexHandle(v);
  };
  std::vector<typename Mesh::VertexHandle> vertices;
  vertices.reserve(points.size());
  for (std::uint32_t k = 0; k < points.size(); ++k) vertices.push_back(add_vertex(k));
  for (const Triangle& t : points.triangles) {
    if (mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid()) continue;
    const std::array own{add_vertex(t[0]), add_vertex(t[1]), add_vertex(t[2])};
    mesh.add_face(own[0], own[1], own[2]);
  }
  return mesh;
}

/// Returns the surface of patches (surface_mesh) as a mesh, as openmesh_of_points() does. Patches
/// that meet at seams are one mesh, which is closed if the scan's mesh was; others are one mesh
/// each. Positions have the precision of `Mesh`; that of OpenMesh::TriMesh is double.
template <class Mesh = OpenMesh::TriMesh>
[[nodiscard]] Result<Mesh> openmesh_of_patches(const PatchModel& model) {
  RELIEF_TRY_ASSIGN(const Points surface, surface_mesh(model));
  return openmesh_of_points<Mesh>(surface);
}

}  // namespace relief
