#include "preprocess/partition/partition.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/preprocess/prepared.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr double kCone = 70.0;

using test::Prepared;

Points two_sheets(double gap) {
  Points points = test::sample_height_field(
      0.5, 0.02, [](double, double) { return 0.0; }, 1);
  const std::size_t lower = points.size();
  for (const glm::dvec3& p : test::sample_height_field(
                                 0.5, 0.02, [&](double, double) { return gap; }, 2)
                                 .positions) {
    points.positions.push_back(p);
  }
  points.normals.assign(points.size(), glm::vec3(0, 0, 1));  // the same normal on both
  EXPECT_GT(points.size(), lower);
  return points;
}

void expect_every_point_once(const std::vector<Region>& regions, std::size_t points) {
  std::vector<int> seen(points, 0);
  for (const Region& region : regions) {
    for (const std::uint32_t i : region.points) ++seen[i];
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(points));
}

TEST(RegionTest, KeepsToTheCone) {
  const Prepared sphere(test::sample_sphere(4000));
  std::vector<std::uint32_t> cap60;
  std::vector<std::uint32_t> cap80;
  for (std::uint32_t i = 0; i < sphere.points.size(); ++i) {
    const double z = sphere.points.positions[i].z;
    if (z > std::cos(60.0 * std::numbers::pi / 180.0)) cap60.push_back(i);
    if (z > std::cos(80.0 * std::numbers::pi / 180.0)) cap80.push_back(i);
  }
  RegionTest test(sphere.samples(), {kCone});
  const auto normal = test.fit(cap60);
  ASSERT_TRUE(normal);
  EXPECT_GT(normal->z, 0.99F);
  EXPECT_FALSE(test.fit(cap80));
}

TEST(RegionTest, FindsTheConesAxisWhereTheMeanIsNot) {
  // A dense cap and a sparse far rim: the mean leans to the dense side, the smallest cone does not.
  const Prepared sphere(test::sample_sphere(6000));
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < sphere.points.size(); ++i) {
    const glm::dvec3 p = sphere.points.positions[i];
    const double angle = std::acos(p.z) * 180.0 / std::numbers::pi;
    const bool rim = std::abs(p.y) < 0.02 && p.x > 0.0 && angle < 115.0;
    if (angle < 12.0 || rim) points.push_back(i);
  }
  const SurfaceSamples samples = sphere.samples();
  EXPECT_TRUE(RegionTest(samples, {kCone}).fit_cone(points));
}

TEST(RegionTest, RefusesTwoSheetsWithOneNormal) {
  const Prepared sheets(two_sheets(0.06));
  std::vector<std::uint32_t> all(sheets.points.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  RegionTest test(sheets.samples(), {kCone});
  EXPECT_TRUE(test.fit_cone(all));
  EXPECT_FALSE(test.fit(all));
}

TEST(Partition, GivesAPlaneOnePatch) {
  const Prepared plane(test::sample_height_field(0.5, 0.02, [](double, double) { return 0.0; }));
  const std::vector<Region> regions = plane.regions(kCone);
  ASSERT_EQ(regions.size(), 1U);
  expect_every_point_once(regions, plane.points.size());
  EXPECT_GT(std::abs(regions[0].normal.z), 0.999F);
}

TEST(Partition, NeedsFewPatchesForASphere) {
  const Prepared sphere(test::sample_sphere(10000));
  const std::vector<Region> regions = sphere.regions(kCone);
  expect_every_point_once(regions, sphere.points.size());
  // Four caps of 70.5 degrees cover a sphere at best; growing regions come within twice that.
  EXPECT_GE(regions.size(), 4U);
  EXPECT_LE(regions.size(), 8U);
}

TEST(Partition, KeepsEveryRegionWithinItsCone) {
  const Prepared torus(test::sample_torus({}, 0.025));
  const std::vector<Region> regions = torus.regions(kCone);
  expect_every_point_once(regions, torus.points.size());
  for (const Region& region : regions) {
    for (const std::uint32_t i : region.points) {
      // Only pieces of at most 16 points (a thousandth of the scan) may go up to 84 degrees.
      EXPECT_GT(glm::dot(region.normal, torus.points.normals[i]), 0.10F);
    }
  }
}

TEST(Partition, PartsSheetsThatShareANormal) {
  for (const double gap_in_spacings : {2.0, 3.0, 6.0}) {
    const Prepared sheets(two_sheets(gap_in_spacings * 0.02));
    const auto lower = static_cast<std::uint32_t>(sheets.points.size() / 2);
    const std::vector<Region> regions = sheets.regions(kCone);
    expect_every_point_once(regions, sheets.points.size());
    for (const Region& region : regions) {
      const auto below = std::count_if(region.points.begin(), region.points.end(),
                                       [&](std::uint32_t i) { return i < lower; });
      EXPECT_TRUE(below == 0 || below == static_cast<std::ptrdiff_t>(region.points.size()))
          << "a region of " << region.points.size() << " points has " << below
          << " on the lower sheet, gap " << gap_in_spacings;
    }
    EXPECT_LE(regions.size(), 4U);
  }
}

}  // namespace
}  // namespace relief
