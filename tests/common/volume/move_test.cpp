// Volumes and Gaussians in their positions.
#include "common/volume/move.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/transform.h"
#include "common/volume/spacing.h"

namespace relief {
namespace {

/// Twice as large, a quarter turn about z, and moved.
Transform quarter_turn() {
  return {{10.0, 20.0, 30.0}, rotation_about({0.0, 0.0, 1.0}, 90.0), 2.0};
}

void expect_near(glm::dvec3 found, glm::dvec3 expected) {
  // The rotation's cosine of 90 degrees is 6e-17.
  EXPECT_NEAR(glm::distance(found, expected), 0.0, 1e-12)
      << found.x << " " << found.y << " " << found.z;
}

TEST(MoveVolume, ARegularGridsNodesGoWhereTheTransformPutsThem) {
  ScalarVolume volume;
  volume.size = {3, 4, 5};
  volume.placement = RegularGrid{{1.0, 2.0, 3.0}, {{0.5, 0.1, 0.0}, {0.0, 1.0, 0.0}, {0, 0, 2}}};
  const auto before = std::get<RegularGrid>(volume.placement);
  move_volume(volume, quarter_turn());
  const auto& after = std::get<RegularGrid>(volume.placement);
  for (const glm::dvec3 node : {glm::dvec3(0, 0, 0), {2, 0, 0}, {0, 3, 0}, {1, 2, 4}}) {
    expect_near(after.origin + after.step * node,
                moved(quarter_turn(), before.origin + before.step * node));
  }
}

TEST(MoveVolume, ARectilinearGridKeepsUnitAxes) {
  ScalarVolume volume;
  volume.size = {2, 2, 3};
  RectilinearGrid before{{1.0, 2.0, 3.0}, glm::dmat3(1.0), {}};
  before.coordinates = {{{0.0, 1.0}, {0.0, 4.0}, {-1.0, 0.0, 5.0}}};
  volume.placement = before;
  move_volume(volume, quarter_turn());
  const auto& after = std::get<RectilinearGrid>(volume.placement);
  for (glm::length_t a = 0; a < 3; ++a) EXPECT_NEAR(glm::length(after.axes[a]), 1.0, 1e-15);
  const auto position = [](const RectilinearGrid& grid, std::size_t i, std::size_t j,
                           std::size_t k) {
    return grid.origin + grid.axes * glm::dvec3(grid.coordinates[0][i], grid.coordinates[1][j],
                                                grid.coordinates[2][k]);
  };
  for (std::size_t k = 0; k < 3; ++k)
    expect_near(position(after, 1, 1, k), moved(quarter_turn(), position(before, 1, 1, k)));
  ScalarVolume unmoved;
  unmoved.placement = before;
  EXPECT_NEAR(mean_spacing(volume), 2.0 * mean_spacing(unmoved), 1e-12);
}

TEST(MoveVolume, ACurvilinearGridsNodesAreMovedOneByOne) {
  ScalarVolume volume;
  volume.size = {2, 1, 1};
  const std::vector<glm::dvec3> before{{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}};
  volume.placement = CurvilinearGrid{before};
  move_volume(volume, quarter_turn());
  const auto& after = std::get<CurvilinearGrid>(volume.placement).positions;
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) expect_near(after[n], moved(quarter_turn(), before[n]));
}

TEST(MoveVolume, ScatteredPointsKeepTheirGradientsInTheField) {
  ScalarVolume volume;
  volume.size = {1, 1, 1};
  volume.placement = ScatteredPoints{{{1.0, 2.0, 3.0}}, {0.5F}, {0.25F}, {{4.0F, 0.0F, 2.0F}}};
  move_volume(volume, quarter_turn());
  const auto& points = std::get<ScatteredPoints>(volume.placement);
  expect_near(points.positions[0], {6.0, 22.0, 36.0});
  EXPECT_EQ(points.spacings[0], 1.0F);
  EXPECT_EQ(points.widths[0], 0.5F);
  expect_near(glm::dvec3(points.gradients[0]), {0.0, 2.0, 1.0});  // half as steep, turned
  EXPECT_EQ(mean_spacing(volume), 1.0);
}

TEST(MoveVolume, NothingElseChanges) {
  ScalarVolume volume;
  volume.size = {2, 1, 1};
  volume.placement = RegularGrid{};
  volume.values = {1.0F, 2.0F};
  move_volume(volume, quarter_turn());
  EXPECT_EQ(volume.values, (std::vector<float>{1.0F, 2.0F}));
  EXPECT_EQ(volume.size, glm::uvec3(2, 1, 1));
}

GaussianCloud one_gaussian(int degree) {
  GaussianCloud cloud;
  cloud.centres = {{1.0F, 2.0F, 3.0F}};
  cloud.scales = {{0.1F, 0.2F, 0.4F}};
  cloud.rotations = {glm::angleAxis(0.7F, glm::normalize(glm::vec3(1.0F, 2.0F, -1.0F)))};
  cloud.opacities = {0.5F};
  cloud.degree = degree;
  cloud.harmonics.assign(harmonics_of(degree), glm::vec3(0.25F));
  return cloud;
}

/// Its variance: that of its own axes, turned.
glm::mat3 variance_of_first(const GaussianCloud& cloud) {
  const glm::mat3 turn = glm::mat3_cast(cloud.rotations[0]);
  glm::mat3 axes(0.0F);
  for (glm::length_t a = 0; a < 3; ++a) axes[a] = cloud.scales[0][a] * turn[a];
  return axes * glm::transpose(axes);
}

TEST(MoveGaussians, TurnsAndScalesTheirVariances) {
  GaussianCloud cloud = one_gaussian(0);
  const glm::mat3 before = variance_of_first(cloud);
  ASSERT_TRUE(move_gaussians(cloud, quarter_turn()));
  const glm::mat3 turn(quarter_turn().rotation);
  const glm::mat3 expected = 4.0F * (turn * before * glm::transpose(turn));
  const glm::mat3 after = variance_of_first(cloud);
  for (glm::length_t c = 0; c < 3; ++c) {
    // Single precision: variances are up to 0.64.
    for (glm::length_t r = 0; r < 3; ++r) EXPECT_NEAR(after[c][r], expected[c][r], 1e-6);
  }
  expect_near(glm::dvec3(cloud.centres[0]), {6.0, 22.0, 36.0});
  EXPECT_EQ(cloud.opacities[0], 0.5F);
}

TEST(MoveGaussians, OfAnyDegreeCanBeMovedAndScaled) {
  GaussianCloud cloud = one_gaussian(2);
  ASSERT_TRUE(move_gaussians(cloud, {{1.0, 0.0, 0.0}, glm::dmat3(1.0), 3.0}));
  expect_near(glm::dvec3(cloud.centres[0]), {4.0, 6.0, 9.0});
  EXPECT_FLOAT_EQ(cloud.scales[0].z, 1.2F);
  EXPECT_EQ(cloud.rotations[0], one_gaussian(2).rotations[0]);
}

}  // namespace
}  // namespace relief
