// One splat under perspective against its true projection, integrated numerically.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

#include "renderer/volume/splats/footprint.h"
#include "true_projection.h"

namespace relief {
namespace {

constexpr double kFocal = 1000.0;

Footprint splat_of(const TrueKernel& kernel) {
  KernelCloud cloud;
  cloud.centres = {kernel.centre};
  cloud.variances = {kernel.variance};
  cloud.weights = {1.0F};
  FootprintRule rule;
  rule.filter = VolumeFilter::Unfiltered;
  rule.cutoff = 100.0;  // exp(-50) lies beyond
  const std::optional<Footprint> footprint = footprint_of(cloud, 0, camera_along_z(kFocal), rule);
  EXPECT_TRUE(footprint);
  return footprint.value_or(Footprint{});
}

/// The largest error `deviations` away from the centre in the image, as a share of the peak.
double error_at(const TrueKernel& kernel, double deviations) {
  const Footprint splat = splat_of(kernel);
  constexpr int kDirections = 32;
  double largest = 0.0;
  for (int d = 0; d < kDirections; ++d) {
    const double angle = 2.0 * std::numbers::pi * d / kDirections;
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    const glm::dvec2 off = direction * (deviations / std::sqrt(splat.q(direction)));
    const double drawn = splat.peak * std::exp(-0.5 * splat.q(off));
    const glm::dvec3 through((splat.centre + off) / kFocal, 1.0);
    largest = std::max(largest, std::abs(drawn - integral_along(kernel, through)));
  }
  return largest / splat.peak;
}

// The numerical integral against the closed form of a round kernel, parts of which are behind the
// eye at the largest size.
TEST(Projection, NumericalIntegralIsTheClosedForm) {
  for (const double sigma : {0.01, 0.1, 0.5}) {
    const glm::dvec3 centre(0.2, -0.1, 0.9);
    for (const glm::dvec3 through :
         {centre, glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.5, 1.0)}) {
      const glm::dvec3 d = glm::normalize(through);
      const double along = glm::dot(centre, d);
      const glm::dvec3 off = centre - along * d;
      const double peak = 1.0 / (2.0 * std::numbers::pi * sigma * sigma);
      const double closed = 0.5 * std::erfc(-along / (sigma * std::numbers::sqrt2)) *
                            std::exp(-0.5 * glm::dot(off, off) / (sigma * sigma)) * peak;
      EXPECT_NEAR(integral_along({centre, round_variance(sigma)}, through), closed, 1e-9 * peak)
          << sigma;
    }
  }
}

// The affine approximation is exact on the ray through the centre, for any shape (the paper's
// Figure 9). 1e-8: the weight 1 of the splat is a float, the integral good to 1e-10.
TEST(Projection, IsExactThroughTheCentre) {
  for (const double degrees : {0.0, 20.0, 45.0, 60.0}) {
    EXPECT_LT(error_at({centre_at(degrees), round_variance(0.05)}, 0.0), 1e-8) << degrees;
    const Variance leaning{4e-4, 3e-4, -1e-4, 9e-4, 2e-4, 6e-4};
    EXPECT_LT(error_at({centre_at(degrees), leaning}, 0.0), 1e-8) << degrees;
  }
}

// Along the axis the error is of second order in the kernel's size, elsewhere of first order.
TEST(Projection, ErrorFallsWithTheKernelsSize) {
  for (const double degrees : {0.0, 30.0}) {
    const double coarse = error_at({centre_at(degrees), round_variance(0.02)}, 1.0);
    const double fine = error_at({centre_at(degrees), round_variance(0.01)}, 1.0);
    const double order = std::log2(coarse / fine);
    // What comes next in the series is 0.02 times as large.
    EXPECT_NEAR(order, degrees == 0.0 ? 2.0 : 1.0, 0.05) << degrees;
  }
}

// Over the distance from the centre it rises and falls again with the kernel, and it grows over the
// field of view. docs/measurements/volume-figures.md has the table.
TEST(Projection, ErrorOverTheFieldOfView) {
  constexpr double kSigma = 0.01;  // about a node of a volume of 100 that fills the image
  double before = 0.0;
  for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0}) {
    const TrueKernel kernel{centre_at(degrees), round_variance(kSigma)};
    const std::array<double, 4> errors{error_at(kernel, 0.5), error_at(kernel, 1.5),
                                       error_at(kernel, 3.0), error_at(kernel, 5.0)};
    EXPECT_GT(errors[1], before) << degrees;
    EXPECT_GT(errors[1], errors[0]) << degrees;
    EXPECT_GT(errors[1], errors[2]) << degrees;
    EXPECT_GT(errors[2], errors[3]) << degrees;
    before = errors[1];
  }
}

}  // namespace
}  // namespace relief
