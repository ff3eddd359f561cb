// The triangles that patches stand for, alone and against what `onepass` draws of them.
#include "renderer/geometry/meshes/mesh_of_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <random>
#include <vector>

#include "common/octahedral.h"
#include "shaders/include/shared.h"
#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using test::must_render;
using test::small_image;
using test::values;

/// Whether a vertex is a sample, and none of those on the border's curve between nodes.
bool is_node(const TriangleMesh& mesh, std::uint32_t vertex) {
  return mesh.uvs[vertex] == glm::round(mesh.uvs[vertex]);
}

/// The triangles between samples.
std::vector<Triangle> between_samples(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  std::ranges::copy_if(mesh.triangles, std::back_inserter(triangles), [&](const Triangle& t) {
    return is_node(mesh, t[0]) && is_node(mesh, t[1]) && is_node(mesh, t[2]);
  });
  return triangles;
}

double area_over_plane(const TriangleMesh& mesh, const Triangle& t) {
  return 0.5 * glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                          mesh.positions[t[2]] - mesh.positions[t[0]])
                   .z;
}

double area_over_plane(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += area_over_plane(mesh, t);
  return area;
}

TEST(MeshOfPatches, HalvesCellsAlongOneDiagonalAndLeavesHolesOut) {
  PatchModel model = test::height_field(7, [](double x, double y) { return 0.2 * x + 0.1 * y; });
  const auto whole = mesh_of_patches(model);
  ASSERT_TRUE(whole);
  EXPECT_EQ(between_samples(*whole).size(), 72U);
  // Every one has the corners (i, j) and (i + 1, j + 1) of its cell.
  for (const Triangle& t : between_samples(*whole)) {
    const glm::vec2 a = whole->uvs[t[0]];
    EXPECT_TRUE(whole->uvs[t[1]] == a + 1.0F || whole->uvs[t[2]] == a + 1.0F);
  }
  for (const Triangle& t : whole->triangles) EXPECT_GT(area_over_plane(*whole, t), 0.0);
  // Up to half a cell beyond its samples, along the slopes, with rounded corners.
  EXPECT_NEAR(area_over_plane(*whole), 49.0, 3.0);

  for (const std::size_t j : {2, 3, 4}) {
    for (const std::size_t i : {2, 3, 4}) model.patches[0].heights[7 * j + i] = kHole;
  }
  const auto torn = mesh_of_patches(model);
  ASSERT_TRUE(torn);
  for (const Triangle& t : torn->triangles) {
    EXPECT_GT(area_over_plane(*torn, t), 0.0);
    for (const std::uint32_t corner : t)
      EXPECT_GT(glm::distance(torn->uvs[corner], glm::vec2(3.0F)), 0.9F);
  }
  EXPECT_NEAR(area_over_plane(*whole) - area_over_plane(*torn), 9.0, 3.0);
}

TEST(MeshOfPatches, HasNothingWhereAPatchJumpsToAnotherSheet) {
  // Two columns of cells, of which the second rises by just as much as splats lean, then by more.
  for (const double rise : {0.99 * shared::kSteepest, 1.01 * shared::kSteepest}) {
    const auto mesh = mesh_of_patches(
        test::height_field(3, [&](double x, double) { return x > 0.5 ? rise : 0.0; }));
    ASSERT_TRUE(mesh);
    const bool joined = rise < shared::kSteepest;
    EXPECT_EQ(between_samples(*mesh).size(), joined ? 8U : 4U);
    if (joined) continue;
    for (const Triangle& t : mesh->triangles) {
      for (const std::uint32_t corner : t)
        EXPECT_NEAR(mesh->positions[corner].z, mesh->positions[t[0]].z, 0.5 * rise);
    }
  }
}

TEST(MeshOfPatches, VerticesHaveWhatTheMapsHoldAtTheirNodes) {
  test::SphereShape shape;
  shape.spacing = 0.1;
  shape.coloured = true;
  PatchModel model = test::sphere_model(shape);
  // Where doubles are 1e-9 apart.
  shape.centre = {5.0e5, 4.2e6, 100.0};
  for (Patch& patch : model.patches) patch.origin += shape.centre;
  // Maps with three texels a cell, of which those between the nodes are of no use here.
  Patch& own_map = model.patches[2];
  AttributeMap<glm::u8vec3> fine{3 * (own_map.width - 1) + 1, 3 * (own_map.height - 1) + 1, 3, {}};
  for (std::uint32_t j = 0; j < fine.height; ++j) {
    for (std::uint32_t i = 0; i < fine.width; ++i) {
      const bool node = i % 3 == 0 && j % 3 == 0;
      fine.texels.push_back(node ? own_map.colours.texels[j / 3 * own_map.width + i / 3]
                                 : glm::u8vec3(1, 2, 3));
    }
  }
  own_map.colours = fine;
  const auto mesh = mesh_of_patches(model);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->colours.size(), mesh->positions.size());
  std::size_t samples = 0;
  for (std::uint32_t k = 0; k < mesh->positions.size(); ++k) {
    if (!is_node(*mesh, k)) continue;
    ++samples;
    const glm::dvec3 outward = mesh->positions[k] - shape.centre;
    // Heights are in steps of a thousandth of a spacing.
    EXPECT_NEAR(glm::length(outward), 1.0, 1e-4);
    // 16-bit octahedral coordinates, and half a step of height on slopes of up to 60 degrees.
    EXPECT_LT(test::degrees_between(glm::dvec3(mesh->normals[k]), glm::normalize(outward)), 0.01);
    for (glm::length_t c = 0; c < 3; ++c) {
      const double byte = 127.5 + 127.0 * glm::normalize(outward)[c];
      EXPECT_NEAR(srgb_from_linear(mesh->colours[k][c]) * 255.0, byte, 1.01);
    }
    EXPECT_EQ(mesh->colours[k].a, 1.0F);
    const Patch& own = model.patches[mesh->patches[k] - 1];
    const auto i = static_cast<std::uint32_t>(mesh->uvs[k].x);
    const auto j = static_cast<std::uint32_t>(mesh->uvs[k].y);
    const glm::dvec3 node = own.origin + own.axes * glm::dvec3(i * own.spacing, j * own.spacing,
                                                               own.at(i, j) * own.height_step);
    EXPECT_EQ(mesh->positions[k], node);
  }
  EXPECT_EQ(samples, count_samples(model));
}

TEST(MeshOfPatches, ARowOfSamplesIsAStripAndAnEmptyPatchNothing) {
  PatchModel model = test::height_field(4, [](double, double) { return 0.0; });
  Patch& patch = model.patches[0];
  patch.height = 1;
  patch.heights.resize(4);
  patch.normals = {};
  const auto row = mesh_of_patches(model);
  ASSERT_TRUE(row);
  EXPECT_TRUE(between_samples(*row).empty());
  EXPECT_NEAR(area_over_plane(*row), 4.0, 1.0);
  patch.heights.assign(4, kHole);
  const auto holes = mesh_of_patches(model);
  ASSERT_TRUE(holes);
  EXPECT_TRUE(holes->positions.empty());
}

/// How far two images of one model are apart where both show the same patch.
struct Differences {
  std::vector<double> depth;    ///< cells
  std::vector<double> uv;       ///< cells
  std::vector<double> degrees;  ///< of the normals
  std::size_t only_drawn = 0;   ///< pixels that `onepass` alone covers
  std::size_t only_traced = 0;
  double rounding =
      0.0;  ///< of depth and uv, by the rasteriser, where the surface slants by 60 degrees

  [[nodiscard]] static double quantile(std::vector<double> values, double share) {
    const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at),
                     values.end());
    return values[at];
  }
};

Differences compare(const PatchModel& model, RenderSettings settings) {
  settings.outputs = test::all_outputs();
  const RenderResult drawn = must_render(model, settings);
  settings.engine = "raytrace";
  settings.raytrace.samples = 1;
  const RenderResult traced = must_render(model, settings);
  Differences differences;
  const double depth = glm::distance(settings.camera.eye, settings.camera.target);
  differences.rounding =
      2.0 * test::rasteriser_rounding(settings, drawn, depth) / model.patches[0].spacing;
  for (std::size_t k = 0; k < values(drawn.image, "Z").size(); ++k) {
    const float patch = values(drawn.image, "patch")[k];
    const float other = values(traced.image, "patch")[k];
    differences.only_drawn += patch > 0.0F && other == 0.0F ? 1 : 0;
    differences.only_traced += patch == 0.0F && other > 0.0F ? 1 : 0;
    if (patch == 0.0F || patch != other) continue;
    const double spacing = model.patches[static_cast<std::size_t>(patch) - 1].spacing;
    differences.depth.push_back(
        std::abs(values(drawn.image, "Z")[k] - values(traced.image, "Z")[k]) / spacing);
    differences.uv.push_back(
        std::hypot(values(drawn.image, "UV.U")[k] - values(traced.image, "UV.U")[k],
                   values(drawn.image, "UV.V")[k] - values(traced.image, "UV.V")[k]));
    differences.degrees.push_back(test::degrees_between(
        glm::normalize(test::normal_of(drawn.image, k)), test::normal_of(traced.image, k)));
  }
  return differences;
}

/// A position is computed in single precision in the frame of a grid with up to 100 nodes a side: a
/// few roundings of 100 * 6e-8 cells.
constexpr double kMeshRounding = 5e-5;

TEST(RayTracedPatches, AreWhatCorrectedInterpolationDraws) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  PatchModel model = test::height_field(40, [&](double x, double y) {
    return 1.5 * std::sin(0.5 * x) * std::cos(0.6 * y) + noise(random);
  });
  model.patches[0].normals = {};
  RenderSettings settings = small_image(model);
  settings.camera = {{0.0, -9.0, 32.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0};
  settings.primitive = Primitive::Quad;
  const Differences corrected = compare(model, settings);
  EXPECT_EQ(corrected.depth.size(), std::size_t{settings.width} * settings.height);
  EXPECT_EQ(corrected.only_drawn + corrected.only_traced, 0U);
  EXPECT_LT(Differences::quantile(corrected.depth, 0.9), kMeshRounding + corrected.rounding);
  EXPECT_LT(Differences::quantile(corrected.uv, 0.9), kMeshRounding + corrected.rounding);
  // In the remaining pixels another splat stands in front than that whose triangle the ray meets:
  // on slopes its tangent plane is above the triangle beside its own. That is within a cell.
  EXPECT_LT(Differences::quantile(corrected.uv, 1.0), 1.0);
  // Direct interpolation is off by what the tangent planes are off the triangles.
  settings.interpolation = Interpolation::Direct;
  EXPECT_GT(Differences::quantile(compare(model, settings).uv, 0.5), 0.01);
}

TEST(RayTracedPatches, HaveTheNormalsOfOnepassAndItHasNoHoles) {
  test::SphereShape shape;
  shape.centre = {3.0, -2.0, 1.0};
  const PatchModel model = test::sphere_model(shape);
  for (const double azimuth : {30.0, 150.0, 270.0}) {
    const Differences corrected = compare(model, small_image(model, {azimuth, 20.0}));
    EXPECT_GT(corrected.depth.size(), 5000U);
    EXPECT_LT(Differences::quantile(corrected.depth, 0.9), kMeshRounding + corrected.rounding);
    EXPECT_LT(Differences::quantile(corrected.uv, 0.9), kMeshRounding + corrected.rounding);
    // Bilinear over a cell there, linear over half of one here: a quarter of how the slope changes
    // across both axes, 0.05^2 * 0.7 where the sphere leans by 45 degrees, is 0.025 degrees; half
    // floats add 0.014.
    EXPECT_LT(Differences::quantile(corrected.degrees, 0.9), 0.04);
    // Border cells are drawn as they are traced, but for pixels that rounding decides.
    EXPECT_LE(corrected.only_traced, 2U);
    EXPECT_LE(corrected.only_drawn, 2U);
  }
}

}  // namespace
}  // namespace relief
