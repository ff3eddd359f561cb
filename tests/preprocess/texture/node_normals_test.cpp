// Normals of samples that are those of the mesh.
#include "preprocess/texture/maps/node_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/octahedral.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr std::uint32_t kNodes = 9;
constexpr double kGridSide = 2.0;

/// A flat patch over [0, 2]^2 in z = 0, in 8 x 8 cells, one node a hole, with normals of its own.
Patch flat_patch() {
  Patch patch;
  patch.spacing = kGridSide / (kNodes - 1);
  patch.height_step = 0.01;
  patch.width = patch.height = kNodes;
  patch.heights.assign(std::size_t{kNodes} * kNodes, 0);
  patch.heights[20] = kHole;
  patch.normals = {kNodes, kNodes, 1, {}};
  patch.normals.texels.assign(std::size_t{kNodes} * kNodes, snorm16_from_unit({0.0F, 0.0F, 1.0F}));
  return patch;
}

/// Not unit: linear, so that what lies between corners is known.
glm::dvec3 leaning(double x, double y) {
  return {0.3 * x - 0.2, 0.1 - 0.25 * y, 1.0};
}

/// `cells` x `cells` squares of two triangles over [0, 2]^2 at a height.
struct Sheet {
  Points mesh;
  std::vector<glm::vec3> normals;
};
Sheet make_sheet(std::uint32_t cells, double z = 0.0, bool faces_up = true) {
  Sheet sheet;
  sheet.mesh =
      test::square_mesh({cells, cells}, kGridSide / cells, [z](double, double) { return z; });
  for (const glm::dvec3& p : sheet.mesh.positions)
    sheet.normals.emplace_back((faces_up ? 1.0 : -1.0) * leaning(p.x, p.y));
  if (!faces_up) {
    for (Triangle& t : sheet.mesh.triangles) std::swap(t[1], t[2]);
  }
  return sheet;
}

Patch with_normals_of(const Sheet& sheet) {
  Patch patch = flat_patch();
  const std::vector<FlatTriangle> triangles = TriangleSpheres(sheet.mesh).find_over(patch);
  take_mesh_normals(sheet.mesh, sheet.normals, triangles, patch);
  return patch;
}

/// The largest angle, degrees, between the samples' normals and `expected(x, y)`.
template <class Expected>
double largest_error(const Patch& patch, const Expected& expected) {
  double least = 1.0;
  for (std::uint32_t j = 0; j < kNodes; ++j) {
    for (std::uint32_t i = 0; i < kNodes; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 normal(unit_from_snorm16(patch.normals.texels[j * kNodes + i]));
      least = std::min(
          least, glm::dot(normal, glm::normalize(expected(i * patch.spacing, j * patch.spacing))));
    }
  }
  return std::acos(least) * 180.0 / std::acos(-1.0);
}
glm::dvec3 up(double /*x*/, double /*y*/) {
  return {0.0, 0.0, 1.0};
}

// Rounding to 16 bits is 0.0025 degrees; acos of what is nearly 1 in single precision adds 0.03.
constexpr double kNodeRounding = 0.04;

TEST(NodeNormals, AreInterpolatedBetweenTheCornersOfTriangles) {
  for (const std::uint32_t cells : {1U, 3U, 7U, 8U}) {
    // What is linear over the sheet is linear over each triangle.
    EXPECT_LT(largest_error(with_normals_of(make_sheet(cells)), leaning), kNodeRounding) << cells;
  }
}

TEST(NodeNormals, HolesContinueTheSamplesAround) {
  const Patch patch = with_normals_of(make_sheet(4));
  const glm::dvec3 hole(unit_from_snorm16(patch.normals.texels[20]));
  EXPECT_GT(glm::dot(hole, glm::normalize(leaning(0.5, 0.5))), 0.999);
}

TEST(NodeNormals, StayWhatTheyAreWhereNoTriangleFacesThePatchsSide) {
  EXPECT_LT(largest_error(with_normals_of(make_sheet(4, 0.0, false)), up), kNodeRounding);
  // Four cells away is another sheet.
  EXPECT_LT(largest_error(with_normals_of(make_sheet(4, 1.0)), up), kNodeRounding);
}

TEST(NodeNormals, OfAMuchFinerMeshStayFitted) {
  // Triangles of 15 squares along 8 cells are just larger than an eighth of a cell, of 17 smaller.
  EXPECT_LT(largest_error(with_normals_of(make_sheet(15)), leaning), kNodeRounding);
  EXPECT_LT(largest_error(with_normals_of(make_sheet(17)), up), kNodeRounding);
}

TEST(NodeNormals, ThatCancelOutAreNotTaken) {
  Sheet sheet = make_sheet(1);
  std::fill(sheet.normals.begin(), sheet.normals.end(), glm::vec3(0.0F));
  EXPECT_LT(largest_error(with_normals_of(sheet), up), kNodeRounding);
}

}  // namespace
}  // namespace relief
