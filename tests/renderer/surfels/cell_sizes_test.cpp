// Cells of surfels that clip lines cut at sharp edges.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "renderer/surfels/surfels.h"

namespace relief {
namespace {

struct OrientedPoints {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
};

/// Two faces that meet at x = 0: a floor with points at half coordinates, and a wall, turned by so
/// many degrees, that is `finer` times as dense along both axes. Points of the floor come first, by
/// x.
OrientedPoints edge_of(int finer, double degrees = 90.0) {
  OrientedPoints points;
  const double turn = degrees * std::numbers::pi / 180.0;
  const glm::dvec3 down(-std::cos(turn), 0.0, -std::sin(turn));
  constexpr int kHalf = 8;
  for (int x = 0; x < kHalf; ++x) {
    for (int y = -kHalf; y < kHalf; ++y) {
      points.positions.emplace_back(x + 0.5, y + 0.5, 0.0);
      points.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  for (int z = 0; z < kHalf * finer; ++z) {
    for (int y = -kHalf * finer; y < kHalf * finer; ++y) {
      points.positions.push_back((z + 0.5) / finer * down +
                                 glm::dvec3(0.0, (y + 0.5) / finer, 0.0));
      points.normals.emplace_back(-std::sin(turn), 0.0, std::cos(turn));
    }
  }
  return points;
}

/// The diameter of the floor's point at (0.5, 0.5).
double size_at_edge(const OrientedPoints& points, bool clipped) {
  Progress silent;
  const auto sizes = find_surfel_sizes(
      points.positions,
      clipped ? std::span<const glm::vec3>(points.normals) : std::span<const glm::vec3>(),
      SurfelSize::Cell, silent);
  if (!sizes) {
    ADD_FAILURE() << sizes.error().message;
    return 0.0;
  }
  return sizes->diameters[8];
}

TEST(CellSizes, ReachTheEdgeThatClipsThem) {
  // A square of one by one, which the edge bounds on one side.
  const double covering = std::sqrt(2.0);
  for (const double degrees : {90.0, 70.0, 65.0}) {
    for (const int finer : {1, 2, 3}) {
      const double size = size_at_edge(edge_of(finer, degrees), true);
      EXPECT_GE(size, covering - 1e-9) << finer << ", " << degrees;
      EXPECT_LE(size, 4.0) << "twice the distance of the eighth on the floor";
    }
  }
}

TEST(CellSizes, OfPositionsAloneEndBeforeADenserFace) {
  // What normals are for: a gap is left at the edge, of 0.05 on either side of each point.
  EXPECT_LT(size_at_edge(edge_of(3), false), std::sqrt(2.0) - 0.1);
}

TEST(CellSizes, OfASmoothSurfaceDoNotDependOnNormals) {
  OrientedPoints points;
  for (int k = 0; k < 900; ++k) {
    points.positions.emplace_back(k % 30, k / 30, 0.01 * (k % 7));
    points.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  Progress silent;
  const auto with = find_surfel_sizes(points.positions, points.normals, SurfelSize::Cell, silent);
  const auto without = find_surfel_sizes(points.positions, {}, SurfelSize::Cell, silent);
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->diameters, without->diameters);
}

TEST(CellSizes, AreFoundWhereNoNeighbourIsOfTheSameSurface) {
  // Each point another direction: a sheet of noise. Cells are those of positions alone, or of the
  // few that agree.
  OrientedPoints points;
  for (int k = 0; k < 400; ++k) {
    points.positions.emplace_back(k % 20, k / 20, 0.0);
    const float angle = 2.4F * static_cast<float>(k);
    points.normals.emplace_back(std::cos(angle), std::sin(angle), 0.0F);
  }
  Progress silent;
  const auto sizes = find_surfel_sizes(points.positions, points.normals, SurfelSize::Cell, silent);
  ASSERT_TRUE(sizes);
  for (const double size : sizes->diameters) {
    EXPECT_GT(size, 0.0);
    EXPECT_LE(size, 2.0 * 30.0) << "no farther than the sheet is wide";
  }
}

}  // namespace
}  // namespace relief
