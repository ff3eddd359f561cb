// Patches that show a mesh's triangles.
#include "preprocess/mesh_fit/fit_to_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/octahedral.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr std::uint32_t kPatchNodes = 9;
constexpr double kCell = 0.5;
constexpr double kPatchSide = kCell * (kPatchNodes - 1);

/// A mesh over [0, `width`] x [0, kPatchSide].
template <class Height>
Points make_square(double width, double side, const Height& height) {
  const auto squares = [side](double length) {
    return static_cast<std::uint32_t>(std::lround(length / side));
  };
  Points mesh = test::square_mesh({squares(width), squares(kPatchSide)}, side, height);
  mesh.normals.assign(mesh.size(), glm::vec3(0.0F, 0.0F, 1.0F));
  return mesh;
}

/// A patch over [0, kPatchSide]^2 with samples at these heights, in steps of a thousandth.
template <class Height>
Patch make_samples(const Height& height) {
  Patch patch;
  patch.spacing = kCell;
  patch.height_step = 0.001;
  patch.width = patch.height = kPatchNodes;
  for (std::uint32_t j = 0; j < kPatchNodes; ++j) {
    for (std::uint32_t i = 0; i < kPatchNodes; ++i) {
      patch.heights.push_back(
          static_cast<std::int32_t>(std::lround(height(i * kCell, j * kCell) / patch.height_step)));
    }
  }
  patch.normals = {kPatchNodes, kPatchNodes, 1, {}};
  patch.normals.texels.assign(patch.heights.size(), snorm16_from_unit({0.0F, 0.0F, 1.0F}));
  return patch;
}

void fit_patch(const Points& mesh, Patch& patch) {
  fit_to_mesh(mesh, mesh.normals, TriangleSpheres(mesh), patch);
}

std::size_t count_holes(const Patch& patch) {
  return static_cast<std::size_t>(std::count(patch.heights.begin(), patch.heights.end(), kHole));
}

/// How far the triangles of all cells lie above a surface, at their edges' middles: mean.
template <class Height>
double mean_offset(const Patch& patch, const Height& height) {
  double sum = 0.0;
  int count = 0;
  for (std::uint32_t j = 0; j + 1 < kPatchNodes; ++j) {
    for (std::uint32_t i = 0; i + 1 < kPatchNodes; ++i) {
      const glm::dvec3 a = position_of(patch, i, j);
      for (const glm::dvec3 b : {position_of(patch, i + 1, j), position_of(patch, i, j + 1),
                                 position_of(patch, i + 1, j + 1)}) {
        const glm::dvec3 middle = 0.5 * (a + b);
        sum += middle.z - height(middle.x, middle.y);
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(FitToMesh, LiesAsMuchOutsideACurvedMeshAsInside) {
  const auto dome = [](double x, double y) {
    return 2.0 - 0.2 * (std::pow(x - 2.0, 2) + std::pow(y - 2.0, 2));
  };
  const Points mesh = make_square(kPatchSide, 0.25, dome);
  Patch patch = make_samples(dome);
  const double before = mean_offset(patch, dome);
  EXPECT_LT(before, -0.01);  // a chord of 0.5 lies 0.2 * 0.25^2 below; diagonals twice that
  fit_patch(mesh, patch);
  EXPECT_EQ(count_holes(patch), 0U);
  // The nodes now lie above; what is left of the offset is their own weight's.
  EXPECT_LT(std::abs(mean_offset(patch, dome)), 0.35 * std::abs(before));
}

TEST(FitToMesh, FollowsTrianglesThatAreElsewhere) {
  // Half a cell above: nearly there, as samples keep a small weight of their own.
  const Points mesh = make_square(kPatchSide, 0.5, [](double, double) { return 0.25; });
  Patch patch = make_samples([](double, double) { return 0.0; });
  fit_patch(mesh, patch);
  for (std::uint32_t j = 0; j < kPatchNodes; ++j) {
    for (std::uint32_t i = 0; i < kPatchNodes; ++i)
      EXPECT_NEAR(position_of(patch, i, j).z, 0.25, 0.06) << i << ", " << j;
  }
}

TEST(FitToMesh, DropsSamplesBesideTheMesh) {
  // The mesh ends a fifth of a cell before column 5.
  const Points mesh = make_square(2.4, 0.4, [](double, double) { return 0.0; });
  Patch patch = make_samples([](double, double) { return 0.0; });
  fit_patch(mesh, patch);
  for (std::uint32_t j = 0; j < kPatchNodes; ++j) {
    for (std::uint32_t i = 0; i < kPatchNodes; ++i)
      EXPECT_EQ(patch.at(i, j) == kHole, i > 5) << i << ", " << j;
  }
}

TEST(FitToMesh, KeepsSamplesAtEdgeOnTriangles) {
  // A wall beside the sheet, which no sample lies above or below.
  Points mesh = make_square(2.4, 0.4, [](double, double) { return 0.0; });
  const auto first = static_cast<std::uint32_t>(mesh.size());
  for (const glm::dvec3 corner : {glm::dvec3(3.0, 0.0, -1.0), glm::dvec3(3.0, kPatchSide, -1.0),
                                  glm::dvec3(3.0, kPatchSide, 1.0), glm::dvec3(3.0, 0.0, 1.0)}) {
    mesh.positions.push_back(corner);
    mesh.normals.emplace_back(1.0F, 0.0F, 0.0F);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  Patch patch = make_samples([](double, double) { return 0.0; });
  fit_patch(mesh, patch);
  for (std::uint32_t i = 0; i < kPatchNodes; ++i) EXPECT_EQ(patch.at(i, 4) == kHole, i > 6) << i;
}

TEST(FitToMesh, LeavesPatchesThatNoTriangleIsNear) {
  const Points mesh = make_square(kPatchSide, 0.5, [](double, double) { return 100.0; });
  Patch patch = make_samples([](double, double) { return 0.0; });
  const std::vector<std::int32_t> before = patch.heights;
  fit_patch(mesh, patch);
  EXPECT_EQ(patch.heights, before);
}

TEST(FitToMesh, LeavesSamplesOfFinerMeshesAsTheyAre) {
  const Points mesh = make_square(kPatchSide, 0.1, [](double, double) { return 0.1; });
  Patch patch = make_samples([](double, double) { return 0.0; });
  const std::vector<std::int32_t> before = patch.heights;
  fit_patch(mesh, patch);
  EXPECT_EQ(patch.heights, before);
}

TEST(FitToMesh, SamplesThatOverhangACreaseHaveItsNormal) {
  // The mesh ends a fifth of a cell before the last samples. Its last points have the mean normal
  // of both sides of a crease there.
  Points mesh = make_square(3.9, 0.3, [](double, double) { return 0.0; });
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    if (mesh.positions[i].x > 3.8) mesh.normals[i] = glm::vec3(0.6F, 0.0F, 0.8F);
  }
  Patch patch = make_samples([](double, double) { return 0.0; });
  fit_patch(mesh, patch);
  ASSERT_NE(patch.at(kPatchNodes - 1, 4), kHole);
  const glm::vec3 normal = unit_from_snorm16(patch.normals.texels[5 * kPatchNodes - 1]);
  EXPECT_NEAR(normal.x, 0.6, 1e-3);  // normals are rounded to 2e-5
  EXPECT_NEAR(normal.z, 0.8, 1e-3);
}

}  // namespace
}  // namespace relief
