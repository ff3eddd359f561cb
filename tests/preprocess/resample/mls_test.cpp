// The moving-least-squares surface over a base plane.
#include "preprocess/resample/heights/mls.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/preprocess/prepared.h"
#include "tests/preprocess/resample/laid_points.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr double kMlsStep = 0.02;

TEST(Mls, ReproducesAQuadricExactly) {
  const auto height = [](double x, double y) {
    return 0.3 + 0.2 * x - 0.1 * y + 0.5 * x * x - 0.4 * x * y + 0.3 * y * y;
  };
  const test::Prepared scan(test::sample_height_field(0.5, kMlsStep, height));
  Region all;
  all.normal = {0, 0, scan.points.normals[0].z > 0.0F ? 1 : -1};
  for (std::uint32_t i = 0; i < scan.points.size(); ++i) all.points.push_back(i);
  const PatchPoints points = collect_patch_points(scan.samples(), scan.graph, all, {}, 0.0);
  const PointGrid lookup(points, points.size(), kMlsStep);
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(0.13, -0.21), glm::dvec2(-0.3, 0.3)}) {
    const MlsPoint surface = evaluate_mls(points, lookup, lookup, at.x, at.y, kMlsStep, true);
    const glm::dvec3 world =
        points.frame.origin + points.frame.axes * glm::dvec3(at.x, at.y, surface.height);
    // The ridge of 0.2 % on the second order is all that is left: curvature 1 over one spacing is
    // 0.0002, of which less than a hundredth may be lost.
    EXPECT_NEAR(world.z, height(world.x, world.y), 2e-6);
  }
}

TEST(Mls, AWallFarBelowThatIsSeenEdgeOnIsNoEstimate) {
  // The surface is z = 0, whose points support samples; the wall x = 0.51 steps, from 3 to 12 steps
  // below, only steadies fits, but is nearest on the base plane along a line of places.
  PatchPoints points;
  const auto add = [&points](glm::dvec3 position, glm::vec3 normal) {
    test::lay_point(points, kMlsStep * position, normal, static_cast<float>(kMlsStep));
  };
  for (int j = -10; j <= 10; ++j) {
    for (int i = -10; i <= 10; ++i) add({i, j, 0.0}, {0.0F, 0.0F, 1.0F});
  }
  points.own = points.supporting = points.size();
  for (int j = -10; j <= 10; ++j) {
    for (int k = 3; k <= 12; ++k) add({0.51, j, -k}, {0.995F, 0.0F, 0.0998F});
  }
  const PointGrid supporting(points, points.supporting, kMlsStep);
  const PointGrid all(points, points.size(), kMlsStep);
  for (double y = -3.0; y <= 3.0; y += 0.25) {
    const MlsPoint surface =
        evaluate_mls(points, supporting, all, 0.5 * kMlsStep, y * kMlsStep, kMlsStep, true);
    EXPECT_NEAR(surface.height, 0.0, 1e-9) << y;
    EXPECT_GT(surface.fitted_normal.z, 0.999999F) << y;
  }
}

/// Points with one normal, all of which support samples; in steps.
PatchPoints points_at(const std::vector<glm::dvec3>& positions, glm::vec3 normal = {0, 0, 1}) {
  PatchPoints points;
  for (const glm::dvec3& position : positions) {
    test::lay_point(points, kMlsStep * position, normal, static_cast<float>(kMlsStep));
  }
  points.own = points.supporting = points.size();
  return points;
}

MlsPoint fit_at_origin(const PatchPoints& points) {
  const PointGrid grid(points, points.size(), kMlsStep);
  return evaluate_mls(points, grid, grid, 0.0, 0.0, kMlsStep, false);
}

TEST(BlendTangents, ReproducesAPlaneExactly) {
  std::vector<glm::dvec3> leaning;
  for (int i = -6; i <= 6; ++i) {
    for (int j = -6; j <= 6; ++j) leaning.emplace_back(i, j + 0.3 * (i % 2), 0.5 * i - 0.25 * j);
  }
  for (glm::dvec3& p : leaning) p.z = 0.5 * p.x - 0.25 * p.y;
  const glm::vec3 normal = glm::normalize(glm::vec3(-0.5F, 0.25F, 1.0F));
  const PatchPoints points = points_at(leaning, normal);
  const PointGrid grid(points, points.size(), kMlsStep);
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1.3, -2.1), glm::dvec2(-7, 6.5)}) {
    const MlsPoint surface =
        blend_tangents(points, grid, grid, at.x * kMlsStep, at.y * kMlsStep, kMlsStep);
    // Normals are rounded to single precision.
    EXPECT_NEAR(surface.height, kMlsStep * (0.5 * at.x - 0.25 * at.y), 1e-7);
    EXPECT_GT(glm::dot(surface.fitted_normal, normal), 0.999999F);
    EXPECT_FALSE(surface.is_replaced);
  }
}

TEST(BlendTangents, LeavesOutPointsBeyondACrest) {
  // A roof: the points of its far side face away by 90 degrees.
  PatchPoints points;
  const auto add = [&points](double x, double y, float slope) {
    const glm::vec3 normal = glm::normalize(glm::vec3(slope, 0.0F, 1.0F));
    test::lay_point(points, kMlsStep * glm::dvec3(x, y, -slope * x), normal,
                    static_cast<float>(kMlsStep));
  };
  for (int j = -6; j <= 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      add(i + 0.5, j, 1.0F);
      add(-i - 0.5, j, -1.0F);
    }
  }
  points.own = points.supporting = points.size();
  const PointGrid grid(points, points.size(), kMlsStep);
  const MlsPoint surface = blend_tangents(points, grid, grid, 0.4 * kMlsStep, 0.0, kMlsStep);
  EXPECT_NEAR(surface.height, -0.4 * kMlsStep, 1e-7);
}

TEST(BlendTangents, WithoutAPointNearbyNothingIsKnown) {
  const PatchPoints points = points_at({{0.0, 0.0, 1.0}});
  const PointGrid grid(points, points.size(), kMlsStep);
  const MlsPoint surface = blend_tangents(points, grid, grid, 2.0, 0.0, kMlsStep);
  EXPECT_TRUE(surface.is_replaced);
  EXPECT_EQ(surface.nearest, PointGrid::kNone);
}

TEST(Mls, TellsHowWellPointsBearAFit) {
  std::vector<glm::dvec3> sheet;
  std::vector<glm::dvec3> line;
  std::vector<glm::dvec3> beside;
  for (int i = -5; i <= 5; ++i) {
    line.emplace_back(i, 0.0, 0.0);
    for (int j = -5; j <= 5; ++j) sheet.emplace_back(i, j, 0.0);
    for (int j = 1; j <= 5; ++j) beside.emplace_back(j, i, 0.0);
  }
  const MlsPoint on_sheet = fit_at_origin(points_at(sheet));
  EXPECT_FALSE(on_sheet.is_replaced);
  EXPECT_LT(on_sheet.condition, 100.0);
  // Ridges of a millionth bound it.
  const MlsPoint on_line = fit_at_origin(points_at(line));
  EXPECT_FALSE(on_line.is_replaced);
  EXPECT_GT(on_line.condition, 1e5);
  EXPECT_LT(on_line.condition, 1e7);
  // The positions go on level, the normals say upward.
  EXPECT_FALSE(fit_at_origin(points_at(beside)).is_replaced);
  EXPECT_TRUE(fit_at_origin(points_at(beside, {0.7F, 0.0F, 0.714F})).is_replaced);
  EXPECT_TRUE(fit_at_origin(points_at({{100.0, 0.0, 0.0}})).is_replaced);
}

}  // namespace
}  // namespace relief
