// How patches share samples.
#include "preprocess/resample/spacing/error_spacing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

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
        at_crease.push_back(0);
      }
      regions.push_back(std::move(region));
    }
  }
  [[nodiscard]] SampleBudget share() const {
    const auto points = static_cast<double>(spacing.size());
    return share({kFewestSamplesPerPoint * points, kMostSamplesPerPoint * points});
  }
  [[nodiscard]] SampleBudget share(SampleRange range, std::span<const double> widths = {}) const {
    return share_samples({positions, normals, spacing, roughness}, regions, at_crease, range,
                         widths);
  }

  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<float> spacing;
  std::vector<float> roughness;
  std::vector<std::uint8_t> at_crease;
  std::vector<Region> regions;
};

/// Samples a point that spacings make, which are 1.1 to a point at factor 1.
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
  // Each is rounded to an eighth of an octave.
  EXPECT_NEAR(std::log2(budget.factors[1] / budget.factors[0]), 1.0 / 3.0, 1.0 / 8.0);
  // What the one gains the other pays for.
  EXPECT_NEAR(samples_per_point(budget), kFewestSamplesPerPoint, 0.1);
}

TEST(ErrorSpacing, AsksForMoreSamplesWhereTheErrorIsTooLarge) {
  // Cells of 1.1 samples a point are sqrt(1 / 1.1) wide, and off by 0.07 of that.
  const double error = 0.07 / std::sqrt(kFewestSamplesPerPoint);
  const SampleBudget budget = BentScan({0.07F}).share();
  EXPECT_NEAR(budget.samples / kRegionPoints, kFewestSamplesPerPoint * error / 0.05, 1e-3);
  // Spacings are rounded to an eighth of an octave, 9 % of the samples either way.
  EXPECT_NEAR(samples_per_point(budget) * kRegionPoints, budget.samples, 0.1 * budget.samples);
}

TEST(ErrorSpacing, AsksForTwiceAsManyAtMost) {
  const SampleBudget budget = BentScan({0.9F, 0.5F}).share();
  EXPECT_NEAR(budget.samples, kMostSamplesPerPoint * 2 * kRegionPoints, 2.0);
}

TEST(ErrorSpacing, GivesAsManySamplesAsAreAskedFor) {
  const BentScan scan({0.04F, 0.02F});
  for (const double wanted : {500.0, 2000.0, 5000.0}) {
    const SampleBudget budget = scan.share({wanted, wanted});
    EXPECT_NEAR(budget.samples, wanted, 1e-3 * wanted);
    EXPECT_NEAR(std::log2(budget.factors[1] / budget.factors[0]), 1.0 / 3.0, 1.0 / 8.0);
  }
}

TEST(ErrorSpacing, PointsAtCreasesDoNotCountAsBent) {
  // A flat side, a tenth of whose points have neighbours on another.
  BentScan scan({0.0F, 0.03F});
  const SampleBudget flat = scan.share();
  for (std::uint32_t i = 0; i < kRegionPoints / 10; ++i) {
    scan.roughness[i] = 0.5F;
    scan.at_crease[i] = 1;
  }
  EXPECT_EQ(scan.share().factors, flat.factors);
  scan.at_crease.assign(scan.at_crease.size(), 0);
  EXPECT_LT(scan.share().factors[0], 0.9 * flat.factors[0]);
}

TEST(ErrorSpacing, OfFlatPatchesIsLimited) {
  const SampleBudget budget = BentScan({0.0F, 0.0F}).share();
  EXPECT_NEAR(budget.factors[0], 1.25, 0.06);
  EXPECT_EQ(budget.factors[1], budget.factors[0]);
}

TEST(ErrorSpacing, OfPointsAtOnePlaceIsDefined) {
  BentScan scan({0.0F});
  for (float& s : scan.spacing) s = 0.0F;
  const SampleBudget budget = scan.share();
  EXPECT_DOUBLE_EQ(budget.factors[0], 1.0);
  EXPECT_TRUE(std::isfinite(budget.samples));
}

TEST(ErrorSpacing, ANarrowFaceHasTwoRowsOfSamples) {
  const double wide = std::numeric_limits<double>::infinity();
  // A tenth as many samples as points: 3.2 spacings apart.
  const BentScan scan({0.02F, 0.02F, 0.02F});
  const double samples = 0.1 * 3 * kRegionPoints;
  const double usual = std::sqrt(10.0);
  const auto spacings = [&](double width) {
    const std::vector<double> widths{width, wide, wide};
    const SampleBudget budget = scan.share({samples, samples}, widths);
    EXPECT_NEAR(budget.samples, samples, 1.0);
    return std::pair(budget.factors[0] * usual, budget.factors[1] * usual);
  };
  // Spacings are rounded to an eighth of an octave.
  const double rounding = std::exp2(1.0 / 16.0) + 1e-9;
  const auto [as_wide, other] = spacings(wide);
  EXPECT_NEAR(as_wide, usual, 1e-6);
  EXPECT_NEAR(other, usual, 1e-6);
  const auto [narrow, beside] = spacings(5.4);
  EXPECT_LT(std::max(narrow / 2.7, 2.7 / narrow), rounding);
  EXPECT_GT(beside, usual);
  // A face of a spacing would need 4,000 samples, and gets half of the 300.
  const auto [thin, rest] = spacings(1.0);
  const double of_half = std::sqrt(kRegionPoints / (0.5 * samples));
  EXPECT_LT(std::max(thin / of_half, of_half / thin), rounding);
  EXPECT_GT(rest, usual);
}

}  // namespace
}  // namespace relief
