// Surroundings above or below a region do not move its samples.
#include "preprocess/resample/surroundings/other_sheets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "preprocess/resample/resample.h"
#include "tests/preprocess/prepared.h"
#include "tests/preprocess/resample/laid_points.h"

namespace relief {
namespace {

constexpr float kSpacing = 0.02F;

TEST(OtherSheets, AreFarAboveOrBelowWhatTheirSlopesAllow) {
  PatchPoints points;
  const auto add = [&points](glm::dvec3 position, glm::vec3 normal) {
    test::lay_point(points, double{kSpacing} * position, glm::normalize(normal), kSpacing);
  };
  for (int j = -5; j <= 5; ++j) {
    for (int i = -5; i <= 5; ++i) add({i, j, 0.0}, {0, 0, 1});
  }
  points.own = points.size();
  add({0.5, 0.5, 4.0}, {0, 0, 1});      // above
  add({6.0, 0.0, 0.2}, {0, 0, 1});      // goes on
  add({7.0, 0.0, 3.4}, {-1.7F, 0, 1});  // goes on up a slope of 60 degrees
  add({0.5, 0.5, -4.0}, {0, 0, 1});     // below
  add({6.0, 2.0, 9.0}, {-5, 0, 1});     // goes on up one of 79
  add({6.0, 3.0, 9.0}, {0, 0, 1});      // above
  points.supporting = points.size();
  add({9.0, 9.0, 0.0}, {-9, 0, 1});  // only for fits already

  const PatchPoints before = points;
  drop_other_sheets(PointGrid(points, points.own, kSpacing), points);
  const auto own = static_cast<std::uint32_t>(points.own);
  EXPECT_EQ(points.supporting, points.own + 3);
  const std::vector<std::uint32_t> surroundings(points.ids.begin() + own, points.ids.end());
  EXPECT_EQ(surroundings, (std::vector<std::uint32_t>{own + 1, own + 2, own + 4, own, own + 3,
                                                      own + 5, own + 6}));
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_EQ(points.positions[p], before.positions[points.ids[p]]);
    EXPECT_EQ(points.normals[p], before.normals[points.ids[p]]);
  }
}

/// A spiral staircase about z without steps: both turns can be seen from above.
struct Spiral {
  static constexpr double kRise = 5.0 * kSpacing;  // a turn
  static double height(double angle) { return kRise * angle / (2.0 * std::numbers::pi); }

  /// Two turns, one to eight spacings from the axis.
  static Points points() {
    Points scan;
    for (int ring = 1; ring <= 8; ++ring) {
      const double radius = ring * double{kSpacing};
      const double slope = height(1.0) / radius;
      for (double angle = -2.0 * std::numbers::pi; angle < 2.0 * std::numbers::pi;
           angle += 1.0 / ring) {
        const glm::dvec2 at(std::cos(angle), std::sin(angle));
        scan.positions.emplace_back(radius * at, height(angle));
        scan.normals.push_back(
            glm::vec3(glm::normalize(glm::dvec3(slope * at.y, -slope * at.x, 1.0))));
      }
    }
    return scan;
  }
};

TEST(OtherSheets, OfASpiralDoNotLiftTheTurnBelow) {
  const test::Prepared scan(Spiral::points());
  std::vector<Region> regions(2);
  for (std::uint32_t i = 0; i < scan.points.size(); ++i)
    regions[scan.points.positions[i].z < 0.0 ? 0 : 1].points.push_back(i);
  for (Region& region : regions) region.normal = {0, 0, 1};
  const Membership membership = membership_of(scan.samples(), regions);
  const Patch patch = resample_region({.samples = scan.samples(),
                                       .graph = scan.graph,
                                       .membership = membership,
                                       .colours = scan.points.colours},
                                      regions[0], {kSpacing, kSpacing / 50.0, 1, 1, false});
  int looked_at = 0;
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 p = position_of(patch, i, j);
      const double radius = glm::length(glm::dvec2(p));
      const double angle = std::atan2(p.y, p.x);
      const double turn = angle > 0.0 ? angle - 2.0 * std::numbers::pi : angle;
      // Near the axis and where the turn begins and ends, a cell away from it is another one.
      if (radius < 2.0 * kSpacing || turn > -0.8 || turn < 0.8 - 2.0 * std::numbers::pi) continue;
      ++looked_at;
      // A node of the other turn would be five spacings off. A tenth is for one-sided fits at the
      // outermost ring.
      EXPECT_NEAR(p.z, Spiral::height(turn), 0.1 * kSpacing) << radius << ' ' << turn;
    }
  }
  EXPECT_GT(looked_at, 100);
}

}  // namespace
}  // namespace relief
