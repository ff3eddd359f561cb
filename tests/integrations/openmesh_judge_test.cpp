// OpenMesh as an independent judge of our meshes: manifold, closed, oriented.
#include <gtest/gtest.h>

// Before any mesh type, as OpenMesh asks for.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/export/export.h"
#include "integrations/openmesh.h"
#include "models/knot_scan.h"
#include "preprocess/convert.h"
#include "preprocess/readers/read_points.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

using Mesh = OpenMesh::TriMesh;

/// A closed body and what is known of it.
struct Body {
  const char* name;
  PatchModel model;              ///< of a scan of it, patches that meet
  long euler;                    ///< vertices - edges + faces: 2 for a sphere, 0 for a torus
  std::optional<double> volume;  ///< nothing: not known
};

PatchModel model_of(Points scan) {
  ConvertOptions options;
  options.seams = true;
  Progress progress;
  auto converted = convert(std::move(scan), options, progress);
  EXPECT_TRUE(converted) << converted.error().message;
  return std::move(converted->model);
}

Points scan_of_knot() {
  const test::ScratchFolder folder;
  std::ofstream(folder / "knot.ply") << knot_scan_ply(20'000);
  Progress progress;
  auto read = read_points(folder / "knot.ply", progress);
  EXPECT_TRUE(read) << read.error().message;
  return std::move(read->points);
}

const std::vector<Body>& bodies() {
  static const std::vector<Body> made = [] {
    const test::Torus torus;
    const double volume = 2.0 * std::pow(std::numbers::pi * torus.minor, 2.0) * torus.major;
    std::vector<Body> all;
    all.push_back(
        {"sphere", model_of(test::sample_sphere(5'000)), 2, 4.0 / 3.0 * std::numbers::pi});
    all.push_back({"torus", model_of(test::sample_torus(torus, 0.04)), 0, volume});
    all.push_back({"knot", model_of(scan_of_knot()), 0, std::nullopt});
    return all;
  }();
  return made;
}

/// `vertices`: as many as there shall be. Triangles that OpenMesh refuses bring more.
void expect_closed(Mesh mesh, const Body& body, std::size_t vertices) {
  EXPECT_EQ(mesh.n_vertices(), vertices);
  std::size_t open = 0;
  std::size_t fans = 0;  // vertices about which triangles form more than one fan
  for (const auto edge : mesh.edges()) open += mesh.is_boundary(edge) ? 1U : 0U;
  for (const auto v : mesh.vertices()) fans += mesh.is_manifold(v) ? 0U : 1U;
  EXPECT_EQ(open, 0U);
  EXPECT_EQ(fans, 0U);
  EXPECT_EQ(static_cast<long>(mesh.n_vertices()) - static_cast<long>(mesh.n_edges()) +
                static_cast<long>(mesh.n_faces()),
            body.euler);

  double volume = 0.0;
  double area = 0.0;
  double turned = 0.0;  // area of triangles that oppose the normals of their corners
  for (const auto face : mesh.faces()) {
    auto corner = mesh.cfv_iter(face);
    const auto a = *corner++;
    const auto b = *corner++;
    const auto c = *corner;
    const auto twice = (mesh.point(b) - mesh.point(a)) % (mesh.point(c) - mesh.point(a));
    volume += (mesh.point(a) | (mesh.point(b) % mesh.point(c))) / 6.0;
    area += twice.norm() / 2.0;
    if ((twice | (mesh.normal(a) + mesh.normal(b) + mesh.normal(c))) < 0.0)
      turned += twice.norm() / 2.0;
  }
  EXPECT_GT(volume, 0.0);  // they face outward
  // Chords of samples a fortieth of a radius apart: 0.12 and 0.15 % when written.
  EXPECT_NEAR(volume / body.volume.value_or(volume), 1.0, 0.003);
  // Small loops between patches are closed even where only a fold closes them (decision 0100):
  // 0.01 to 0.08 % when written.
  EXPECT_LT(turned / area, 0.001);
}

TEST(OpenMeshJudges, SurfacesAreClosedManifolds) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const auto surface = surface_mesh(body.model);
    auto mesh = openmesh_of_patches(body.model);
    ASSERT_TRUE(surface && mesh);
    expect_closed(std::move(*mesh), body, surface->size());
  }
}

TEST(OpenMeshJudges, ExportedFilesAreClosedManifolds) {
  const test::ScratchFolder folder;
  for (const Body& body : bodies()) {
    const auto surface = surface_mesh(body.model);
    ASSERT_TRUE(surface) << surface.error().message;
    for (const std::string ending : {".ply", ".obj"}) {
      SCOPED_TRACE(body.name + ending);
      const std::filesystem::path path = folder / (body.name + ending).c_str();
      Progress progress;
      const auto write = ending == ".ply" ? export_ply : export_obj;
      ASSERT_TRUE(write(path, {*surface, 1e-6}, progress));
      Mesh mesh;
      mesh.request_vertex_normals();
      OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal;
      ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, path.string(), options));
      EXPECT_TRUE(options.vertex_has_normal());
      expect_closed(std::move(mesh), body, surface->size());
    }
  }
}

// A closed mesh in, and its patches back: closed, with as many handles.
TEST(OpenMeshJudges, MeshesStayClosedManifoldsWhenConverted) {
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const auto mesh = openmesh_of_patches(body.model);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const PatchModel again = model_of(points_of_openmesh(*mesh));
    EXPECT_TRUE(again.is_closed);
    const auto surface = surface_mesh(again);
    auto back = openmesh_of_patches(again);
    ASSERT_TRUE(surface && back);
    expect_closed(std::move(*back), body, surface->size());
  }
}

// Without seams each patch is a mesh of its own, open, and has no triangle that OpenMesh refuses.
TEST(OpenMeshJudges, OverlappingPatchesAreManifoldsEach) {
  Progress progress;
  const auto converted = convert(test::sample_sphere(5'000), {}, progress);
  ASSERT_TRUE(converted) << converted.error().message;
  const auto mesh = openmesh_of_patches(converted->model);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->n_vertices(), count_samples(converted->model));
  EXPECT_GT(mesh->n_faces(), mesh->n_vertices());
}

}  // namespace
}  // namespace relief
