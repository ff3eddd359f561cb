// Meshes of OpenMesh in, patches out, meshes back.
#include "integrations/openmesh.h"

#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

#include "preprocess/convert.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoubleMesh = OpenMesh::TriMesh;  // double positions and normals, colours of four floats
using Polygons = OpenMesh::PolyMesh;

/// A cube of six squares, outward.
Polygons cube() {
  Polygons mesh;
  std::vector<Polygons::VertexHandle> v;
  for (int k = 0; k < 8; ++k) v.push_back(mesh.add_vertex({k & 1, (k >> 1) & 1, (k >> 2) & 1}));
  for (const auto& f : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    mesh.add_face({v[static_cast<std::size_t>(f[0])], v[static_cast<std::size_t>(f[1])],
                   v[static_cast<std::size_t>(f[2])], v[static_cast<std::size_t>(f[3])]});
  }
  return mesh;
}

double volume_of(const Points& mesh) {
  double six = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]));
  }
  return six / 6.0;
}

TEST(OpenMeshMesh, ComesInWithItsPolygonsSplit) {
  const Points points = points_of_openmesh(cube());
  EXPECT_EQ(points.size(), 8U);
  EXPECT_EQ(points.triangles.size(), 12U);
  EXPECT_DOUBLE_EQ(volume_of(points), 1.0);  // outward still
  EXPECT_TRUE(points.normals.empty());
  EXPECT_TRUE(points.colours.empty());
}

TEST(OpenMeshMesh, ComesInWithoutWhatIsDeleted) {
  Polygons mesh = cube();
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.delete_vertex(mesh.vertex_handle(0));  // and the three faces there
  const Points points = points_of_openmesh(mesh);
  EXPECT_EQ(points.size(), 7U);
  ASSERT_EQ(points.triangles.size(), 6U);
  for (const Triangle& t : points.triangles) {
    // The faces left are those on the far sides: where x, y or z is 1.
    const glm::dvec3 low =
        glm::min(glm::min(points.positions[t[0]], points.positions[t[1]]), points.positions[t[2]]);
    EXPECT_EQ(std::max({low.x, low.y, low.z}), 1.0);
  }
}

template <class Mesh>
Mesh one_triangle() {
  Mesh mesh;
  mesh.request_vertex_normals();
  mesh.request_vertex_colors();
  const auto a = mesh.add_vertex({0, 0, 0});
  const auto b = mesh.add_vertex({1, 0, 0});
  const auto c = mesh.add_vertex({0, 1, 0});
  mesh.add_face(a, b, c);
  for (const auto v : mesh.vertices()) mesh.set_normal(v, {0, 0, 1});
  return mesh;
}

TEST(OpenMeshMesh, ComesInWithNormalsAndColours) {
  auto bytes = one_triangle<FloatMesh>();
  for (const auto v : bytes.vertices()) bytes.set_color(v, {255, 128, 0});
  auto reals = one_triangle<DoubleMesh>();
  for (const auto v : reals.vertices()) reals.set_color(v, {7.0F, 128.0F / 255.0F, -1.0F, 1.0F});
  for (const Points& points : {points_of_openmesh(bytes), points_of_openmesh(reals)}) {
    EXPECT_EQ(points.normals, std::vector(3, glm::vec3(0.0F, 0.0F, 1.0F)));
    EXPECT_EQ(points.colours, std::vector(3, glm::u8vec3(255, 128, 0)));
  }
}

/// Patches that meet.
ConvertResult converted_sphere(bool colours) {
  Points sphere = test::sample_sphere(3'000);
  if (colours) sphere.colours.assign(sphere.size(), glm::u8vec3(200, 100, 50));
  ConvertOptions options;
  options.seams = true;
  Progress progress;
  auto converted = convert(std::move(sphere), options, progress);
  EXPECT_TRUE(converted) << converted.error().message;
  return std::move(*converted);
}

template <class Mesh>
void expect_coloured_sphere(const Mesh& mesh) {
  const Points points = points_of_openmesh(mesh);
  EXPECT_EQ(points.size(), mesh.n_vertices());  // none at one place
  EXPECT_EQ(points.triangles.size(), mesh.n_faces());
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(glm::length(points.positions[k]), 1.0, 0.01);
    EXPECT_GT(glm::dot(points.normals[k], glm::vec3(points.positions[k])), 0.98F);
    EXPECT_EQ(glm::ivec3(points.colours[k]), glm::ivec3(200, 100, 50));
  }
}

TEST(OpenMeshSurface, HasNormalsAndColoursInEachPrecision) {
  const ConvertResult sphere = converted_sphere(true);
  const auto single = openmesh_of_patches<FloatMesh>(sphere.model);
  ASSERT_TRUE(single) << single.error().message;
  expect_coloured_sphere(*single);
  const auto twice = openmesh_of_patches(sphere.model);
  ASSERT_TRUE(twice) << twice.error().message;
  expect_coloured_sphere(*twice);
}

TEST(OpenMeshSurface, HasNoColoursIfTheModelHasNone) {
  const auto mesh = openmesh_of_patches(converted_sphere(false).model);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_FALSE(mesh->has_vertex_colors());
}

// Two triangles on one edge in the same sense: the second gets vertices of its own.
TEST(OpenMeshSurface, SeparatesTrianglesThatAreNoManifold) {
  Points fan;
  fan.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  const auto mesh = openmesh_of_points<FloatMesh>(fan);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->n_faces(), 3U);
  EXPECT_EQ(mesh->n_vertices(), 8U);
  EXPECT_FALSE(mesh->has_vertex_normals());
}

}  // namespace
}  // namespace relief
