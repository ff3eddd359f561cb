// How much noise is found on thin plates, beside thin parts, and where it varies.
#include "preprocess/noise/noise_level.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/median.h"
#include "common/neighbours/neighbours.h"
#include "tests/preprocess/noise/noisy_surfaces.h"

namespace relief {
namespace {

/// The noise of points, by point.
std::vector<float> noise_of(const std::vector<glm::dvec3>& positions) {
  const PositionTree tree(positions);
  const NeighbourGraph graph = find_neighbours(positions, kSurfaceNeighbours);
  std::vector<float> spacing(positions.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot)
    spacing[slot] = graph.spacing[tree.index(slot)];
  const std::vector<float> by_slot = estimate_noise(tree, spacing);
  std::vector<float> noise(positions.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) noise[tree.index(slot)] = by_slot[slot];
  return noise;
}

/// Two sheets so many spacings apart.
test::RandomScan two_sheets(std::size_t count, double apart, unsigned seed) {
  test::RandomScan scan = test::random_plane(count, seed);
  const test::RandomScan other = test::random_plane(count, seed + 1);
  for (glm::dvec3 p : other.positions) {
    p.z = apart * scan.spacing;
    scan.positions.push_back(p);
  }
  return scan;
}

// Discs five times as wide as the noise reach the other sheet. On twelve seeds 0.83 to 1.06 of it
// is found; with such discs alone, nothing of the largest.
TEST(NoiseLevel, IsFoundOnPlatesTenSpacingsThick) {
  for (const double noise : {0.5, 1.0, 1.5}) {
    const test::RandomScan plate = two_sheets(3'000, 10.0, 1);
    const double found = median_of(noise_of(test::with_noise(plate, noise)));
    EXPECT_NEAR(found / (noise * plate.spacing), 1.0, 0.25) << noise;
  }
}

// A strip has a second sheet five spacings above, as an ear has: that looks like noise of twice as
// much, 2.2 times at a tenth of its points.
TEST(NoiseLevel, IsHardlyMoreWhereAPartIsThin) {
  test::RandomScan scan = test::random_plane(20'000, 1);
  const std::size_t below = scan.positions.size();
  for (glm::dvec3 p : test::random_plane(20'000, 2).positions) {
    p.z = 5.0 * scan.spacing;
    if (p.x < 0.04) scan.positions.push_back(p);
  }
  const std::vector<float> noise = noise_of(test::with_noise(scan, 1.0));
  const float usual = median_of(noise);
  EXPECT_NEAR(usual / scan.spacing, 1.0, 0.1);
  std::vector<float> thin(noise.begin() + static_cast<std::ptrdiff_t>(below), noise.end());
  std::ranges::sort(thin);
  EXPECT_LT(thin[thin.size() * 9 / 10], 1.6 * usual);
}

// Half of a scan is four times as noisy as the other.
TEST(NoiseLevel, IsThatOfThePlace) {
  const test::RandomScan plane = test::random_plane(20'000);
  const auto quiet = test::with_noise(plane, 0.15);
  const auto loud = test::with_noise(plane, 0.6);
  std::vector<glm::dvec3> positions = quiet;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (plane.positions[i].x > 0.5) positions[i] = loud[i];
  }
  const std::vector<float> noise = noise_of(positions);
  std::vector<float> left;
  std::vector<float> right;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (plane.positions[i].x < 0.4) left.push_back(noise[i]);
    if (plane.positions[i].x > 0.6) right.push_back(noise[i]);
  }
  EXPECT_NEAR(median_of(left) / plane.spacing, 0.15, 0.03);
  EXPECT_NEAR(median_of(right) / plane.spacing, 0.6, 0.1);
}

}  // namespace
}  // namespace relief
