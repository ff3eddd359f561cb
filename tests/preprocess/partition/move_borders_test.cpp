#include "preprocess/partition/move_borders.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "preprocess/partition/region_cells.h"
#include "tests/preprocess/prepared.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

using test::Prepared;

constexpr double kSpacing = 0.02;
constexpr BorderWeights kWeights{0.3, 4.0};

/// A square of one side in the plane, or two squares that meet along y = 0 in a roof of this angle.
Points roof(double degrees) {
  Points points = test::sample_height_field(0.5, kSpacing, [](double, double) { return 0.0; });
  points.normals.clear();
  const double lean = (180.0 - degrees) / 2.0 * std::numbers::pi / 180.0;
  for (glm::dvec3& p : points.positions) {
    const double side = p.x < 0.0 ? -1.0 : 1.0;
    points.normals.emplace_back(side * std::sin(lean), 0.0, std::cos(lean));
    p = {p.x * std::cos(lean), p.y, -std::abs(p.x) * std::sin(lean)};
  }
  return points;
}

/// The regions of those points that `first` accepts and of the others.
std::vector<Region> two_regions(const Prepared& scan,
                                const std::function<bool(glm::dvec3)>& first) {
  std::vector<Region> regions(2);
  for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
    regions[first(scan.points.positions[i]) ? 0 : 1].points.push_back(i);
  }
  for (Region& region : regions) {
    glm::vec3 sum(0.0F);
    for (const std::uint32_t i : region.points) sum += scan.points.normals[i];
    region.normal = glm::normalize(sum);
  }
  return regions;
}

/// Neighbours that are in different regions.
std::size_t border_pairs(const Prepared& scan, const std::vector<Region>& regions) {
  const Membership membership = membership_of(scan.samples(), regions);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    for (const std::uint32_t j : scan.graph.of(i).first(8)) {
      if (membership.region[i] != membership.region[j]) ++pairs;
    }
  }
  return pairs;
}

TEST(MoveBorders, StraightensWhatIsRagged) {
  const Prepared plane(roof(180.0));
  // Teeth of four spacings, three wide.
  std::vector<Region> regions = two_regions(plane, [](glm::dvec3 p) {
    const bool tooth = std::fmod(p.y + 1.0, 6.0 * kSpacing) < 3.0 * kSpacing;
    return p.x < (tooth ? 4.0 * kSpacing : 0.0);
  });
  std::vector<Region> straight = two_regions(plane, [](glm::dvec3 p) { return p.x < 0.0; });
  const std::size_t before = border_pairs(plane, regions);
  move_borders(plane.samples(), plane.graph, 70.0, kWeights, regions);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].points.size() + regions[1].points.size(), plane.points.size());
  // Teeth make it more than twice as long; bumps that no single point can better are left.
  EXPECT_GT(before, 2 * border_pairs(plane, straight));
  EXPECT_LT(border_pairs(plane, regions), border_pairs(plane, straight) * 4 / 3);
}

TEST(MoveBorders, FollowsACrease) {
  const Prepared scan(roof(100.0));
  // One region begins four spacings beyond the crease.
  std::vector<Region> regions =
      two_regions(scan, [](glm::dvec3 p) { return p.x < 4.0 * kSpacing; });
  move_borders(scan.samples(), scan.graph, 70.0, kWeights, regions);
  ASSERT_EQ(regions.size(), 2U);
  for (std::size_t r = 0; r < 2; ++r) {
    std::size_t beyond = 0;
    for (const std::uint32_t i : regions[r].points) {
      const double x = scan.points.positions[i].x;
      if (r == 0 ? x > kSpacing : x < -kSpacing) ++beyond;
    }
    EXPECT_EQ(beyond, 0U) << "region " << r;
  }
}

TEST(MoveBorders, KeepsTheCone) {
  const Prepared sphere(test::sample_sphere(4000));
  std::vector<Region> regions = sphere.regions(50.0);
  // Away from where every point may have the cone that merging gave it.
  for (int round = 0; round < 3; ++round) {
    move_borders(sphere.samples(), sphere.graph, 50.0, {0.0, 0.0}, regions);
  }
  const float least = std::cos(glm::radians(50.0F)) - 1e-4F;
  for (const Region& region : regions) {
    for (const std::uint32_t i : region.points) {
      EXPECT_GE(glm::dot(region.normal, sphere.points.normals[i]), least);
    }
  }
}

TEST(RegionCells, RefuseAPointOfAnotherSheet) {
  Points points = test::sample_height_field(
      0.5, kSpacing, [](double, double) { return 0.0; }, 1);
  const auto lower = static_cast<std::uint32_t>(points.size());
  const Points upper = test::sample_height_field(
      0.5, kSpacing, [](double, double) { return 0.06; }, 2);
  points.positions.insert(points.positions.end(), upper.positions.begin(), upper.positions.end());
  points.normals.assign(points.size(), glm::vec3(0, 0, 1));
  const Prepared sheets(std::move(points));
  std::vector<Region> regions(2);
  for (std::uint32_t i = 0; i < sheets.points.size(); ++i) {
    // A tenth of the lower points are in the upper sheet's region, by mistake.
    regions[i < lower && i % 10 != 0 ? 0 : 1].points.push_back(i);
  }
  for (Region& region : regions) region.normal = {0, 0, 1};
  RegionCells cells(sheets.samples(), regions);
  for (std::uint32_t i = 0; i < lower; i += 10) {
    EXPECT_TRUE(cells.is_on_its_sheet(i, 0));
    cells.move(i, 0);
    EXPECT_EQ(cells.owner(i), 0U);
  }
  std::size_t refused = 0;
  for (std::uint32_t i = lower; i < sheets.points.size(); ++i) {
    if (!cells.is_on_its_sheet(i, 0)) ++refused;
  }
  // Cells of 1.5 spacings hold 2.25 points on average; few are empty.
  EXPECT_GT(refused, (sheets.points.size() - lower) * 3 / 4);
}

}  // namespace
}  // namespace relief
