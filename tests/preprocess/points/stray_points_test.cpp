// Points off every surface are stray; those of thin, sharp and uneven ones are not.
#include "preprocess/points/stray_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/preprocess/noise/noisy_surfaces.h"

namespace relief {
namespace {

std::vector<std::uint8_t> stray_of(const std::vector<glm::dvec3>& positions) {
  return find_stray_points(positions, find_neighbours(positions, kSurfaceNeighbours));
}

std::ptrdiff_t count(const std::vector<std::uint8_t>& marks) {
  return std::ranges::count(marks, 1);
}

TEST(StrayPoints, ArePointsAboveASurface) {
  test::RandomScan plane = test::random_plane(5'000);
  const std::size_t surface = plane.positions.size();
  for (int k = 0; k < 20; ++k) {
    plane.positions.emplace_back(0.1 + 0.2 * (k % 5), 0.1 + 0.25 * (k / 5),
                                 (2.5 + 0.5 * k) * plane.spacing);
  }
  const std::vector<std::uint8_t> stray = stray_of(plane.positions);
  EXPECT_EQ(count({stray.begin() + static_cast<std::ptrdiff_t>(surface), stray.end()}), 20);
  EXPECT_EQ(count({stray.begin(), stray.begin() + static_cast<std::ptrdiff_t>(surface)}), 0);
}

TEST(StrayPoints, AreCloudsOfThem) {
  test::RandomScan cube = test::random_cube(10'000);
  const std::size_t surface = cube.positions.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(2.0, 4.0);
  for (int k = 0; k < 500; ++k) cube.positions.emplace_back(any(random), any(random), any(random));
  const std::vector<std::uint8_t> stray = stray_of(cube.positions);
  EXPECT_EQ(count({stray.begin(), stray.begin() + static_cast<std::ptrdiff_t>(surface)}), 0);
  // By chance some neighbourhoods in a cloud are flat.
  EXPECT_GT(count(stray), 400);
}

TEST(StrayPoints, AreNotPointsOfNoise) {
  for (const double noise : {0.25, 1.0}) {
    const auto positions = test::with_noise(test::random_cube(10'000), noise);
    EXPECT_LT(count(stray_of(positions)), 50) << noise;  // the tails: half a per cent
  }
}

TEST(StrayPoints, AreNotCornersOrPointsWhereTheDensityJumps) {
  EXPECT_EQ(count(stray_of(test::random_cube(3'000).positions)), 0);
  // A strip 25 times as dense as the plane beside it.
  std::vector<glm::dvec3> positions = test::random_plane(2'000).positions;
  for (const glm::dvec3& p : test::random_plane(25'000).positions)
    positions.emplace_back(p.x * 0.5 - 0.5, p.y, 0.0);
  EXPECT_EQ(count(stray_of(positions)), 0);
}

TEST(StrayPoints, NeedEightNeighbours) {
  EXPECT_EQ(count(stray_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 9}})), 0);
}

}  // namespace
}  // namespace relief
