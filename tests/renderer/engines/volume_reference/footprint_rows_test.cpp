#include "renderer/engines/volume_reference/footprint_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace relief::volume_reference {
namespace {

constexpr std::int64_t kHeight = 40;

/// Of an ellipse with those radii (standard deviations, pixels), turned, at a place.
Footprint ellipse(glm::dvec2 radii, double angle, glm::dvec2 centre, double cutoff) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double a = 1.0 / (radii.x * radii.x);
  const double b = 1.0 / (radii.y * radii.y);
  Footprint footprint;
  footprint.centre = centre;
  footprint.peak = 0.7;
  footprint.xx = a * c * c + b * s * s;
  footprint.xy = (a - b) * c * s;
  footprint.yy = a * s * s + b * c * c;
  footprint.cutoff = cutoff;
  footprint.reach = {std::sqrt(cutoff * footprint.yy / (a * b)),
                     std::sqrt(cutoff * footprint.xx / (a * b))};
  return footprint;
}

/// Every pixel's weight against peak * exp(-q / 2), or none from the cutoff on.
void expect_exact(const Footprint& footprint, const std::string& what) {
  const FootprintRows rows(footprint, kHeight);
  RowWeights row;
  for (std::int64_t left = 0; left < 48; left += kTile) {
    const std::int64_t right = left + kTile - 1;
    for (std::int64_t y = 0; y < kHeight; ++y) {
      rows.row(y, left, right, row);
      for (std::int64_t x = left; x <= right; ++x) {
        const double q = footprint.q(rows.from_centre(x, y));
        // Rounding decides who is in at the border itself: off by 1e-9 is neither.
        if (std::abs(q - footprint.cutoff) < 1e-9 * (1.0 + footprint.xx)) continue;
        const bool is_in = x >= row.first && x <= row.last;
        ASSERT_EQ(is_in, q < footprint.cutoff) << what << ", pixel " << x << ", " << y;
        if (!is_in) continue;
        const double expected = footprint.peak * std::exp(-0.5 * q);
        const double weight = row.weights[static_cast<std::size_t>(x - row.first)];
        // Fifteen products, each of whose factors is rounded: 1e-15 each, and the exponents' own
        // rounding, which grows with the terms that cancel in them.
        ASSERT_NEAR(weight, expected, 1e-11 * expected) << what << ", pixel " << x << ", " << y;
      }
    }
  }
}

TEST(FootprintRows, AreThoseOfTheExponential) {
  expect_exact(ellipse({3.0, 3.0}, 0.0, {20.3, 17.8}, 4.0), "round");
  expect_exact(ellipse({9.0, 1.5}, 0.6, {22.0, 20.0}, 9.0), "turned");
  expect_exact(ellipse({30.0, 0.4}, -1.1, {15.2, 11.9}, 20.0), "long and thin, all of the cutoff");
  expect_exact(ellipse({0.05, 0.05}, 0.0, {8.5, 30.5}, 4.0), "smaller than a pixel");
  expect_exact(ellipse({500.0, 200.0}, 0.3, {-300.0, 150.0}, 4.0), "larger than the image");
}

TEST(FootprintRows, AreEmptyFarFromTheFootprint) {
  for (const glm::dvec2 centre : {glm::dvec2(1e12, 3.0), glm::dvec2(-1e12, 3.0),
                                  glm::dvec2(20.0, 1e15), glm::dvec2(-200.0, 20.0)}) {
    const Footprint footprint = ellipse({3.0, 2.0}, 0.4, centre, 4.0);
    const FootprintRows rows(footprint, kHeight);
    RowWeights row;
    for (std::int64_t y = 0; y < kHeight; ++y) {
      rows.row(y, 16, 31, row);
      EXPECT_LT(row.last, row.first);
    }
  }
}

}  // namespace
}  // namespace relief::volume_reference
