// How patches share samples.
#include "preprocess/resample/error_spacing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relief {
namespace {

constexpr std::uint32_t kRegionPoints = 1000;

/// Regions of as many points each, one spacing apart, whose neighbours are so far from a plane.
struct BentScan {
  explicit BentScan(const std::vector<float>& off_plane) {
    for (const float off : off_plane) {
      Region region;
      for (std::uint32_t i = 0; i < kRegionPoints; ++i) {
        region.points.push_back(static_cast<std::uint32_t>(spacing.size()));
        spacing.push_back(1.0F);
        roughness.push_back(off);
      }
      regions.push_back(std::move(region));
    }
  }
  [[nodiscard]] SampleBudget share() const {
    return share_samples({positions, normals, spacing, roughness}, regions, spacing.size());
  }

  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<float> spacing;
  std::vector<float> roughness;
  std::vector<Region> regions;
};

/// Samples a point that spacings make, which are one to a point at factor sqrt(1.15).
double samples_per_point(const SampleBudget& budget) {
  double sum = 0.0;
  for (const double factor : budget.factors) sum += kFewestSamplesPerPoint / (factor * factor);
  return sum / static_cast<double>(budget.factors.size());
}

TEST(ErrorSpacing, IsTheSameWherePatchesBendAlike) {
  const SampleBudget budget = BentScan({0.03F, 0.03F}).share();
  EXPECT_NEAR(budget.factors[0], 1.0, 1e-3);
  EXPECT_NEAR(budget.factors[1], 1.0, 1e-3);
  EXPECT_NEAR(budget.samples, kFewestSamplesPerPoint * 2 * kRegionPoints, 1.0);
}

TEST(ErrorSpacing, FallsWithTheCubeRootOfTheBend) {
  const SampleBudget budget = BentScan({0.04F, 0.02F}).share();
  EXPECT_NEAR(budget.factors[1] / budget.factors[0], std::cbrt(2.0), 1e-3);
  // What the one gains the other pays for.
  EXPECT_NEAR(samples_per_point(budget), kFewestSamplesPerPoint, 1e-2);
}

TEST(ErrorSpacing, AsksForMoreSamplesWhereTheErrorIsTooLarge) {
  // 0.07 at one sample a point is a twentieth at 1.4 samples.
  const SampleBudget budget = BentScan({0.07F}).share();
  EXPECT_NEAR(budget.samples / kRegionPoints, 1.4, 0.01 * 1.4 + 0.1);
  EXPECT_NEAR(samples_per_point(budget) * kRegionPoints, budget.samples, 1.0);
}

TEST(ErrorSpacing, AsksForTwiceAsManyAtMost) {
  const SampleBudget budget = BentScan({0.9F, 0.5F}).share();
  EXPECT_NEAR(budget.samples, kMostSamplesPerPoint * 2 * kRegionPoints, 2.0);
}

TEST(ErrorSpacing, OfFlatPatchesIsLimited) {
  const SampleBudget budget = BentScan({0.0F, 0.0F}).share();
  EXPECT_DOUBLE_EQ(budget.factors[0], 1.3);
  EXPECT_DOUBLE_EQ(budget.factors[1], 1.3);
}

TEST(ErrorSpacing, OfPointsAtOnePlaceIsDefined) {
  BentScan scan({0.0F});
  for (float& s : scan.spacing) s = 0.0F;
  const SampleBudget budget = scan.share();
  EXPECT_DOUBLE_EQ(budget.factors[0], 1.0);
  EXPECT_TRUE(std::isfinite(budget.samples));
}

}  // namespace
}  // namespace relief
