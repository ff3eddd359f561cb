// The resampling filter of the engine `ewa`, against the exact projection and the integrals that
// theory states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>
#include <vector>

#include "renderer/engines/ewa/resampling_filter.h"

namespace relief::ewa {
namespace {

/// A point before the eye with a tangent plane that is seen at 6 degrees or more.
struct Splat {
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0};
  double radius = 0.0;
};

const PixelMapping kMapping{600.0, {320.0, 256.0}};

std::vector<Splat> random_splats(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Splat> splats;
  while (splats.size() < count) {
    Splat splat;
    splat.point = {unit(random), unit(random), 2.0 + unit(random)};
    splat.normal = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
    // From a tenth of a pixel to 30 pixels.
    splat.radius =
        splat.point.z / kMapping.scale * std::pow(10.0, -1.0 + 1.24 * (1 + unit(random)));
    if (std::abs(glm::dot(splat.normal, glm::normalize(splat.point))) > 0.1)
      splats.push_back(splat);
  }
  return splats;
}

/// Where the ray through a pixel meets a splat's tangent plane.
glm::dvec3 back_projected(const Splat& splat, glm::dvec2 pixel) {
  const glm::dvec3 ray((pixel - kMapping.middle) / kMapping.scale, 1.0);
  return glm::dot(splat.normal, splat.point) / glm::dot(splat.normal, ray) * ray;
}

TEST(ResamplingFilter, JacobianIsThatOfTheExactProjection) {
  for (const Splat& splat : random_splats(200)) {
    const auto plane = map_tangent_plane(kMapping, splat.point, splat.normal);
    ASSERT_TRUE(plane);
    // Central differences of the back projection, with an error of the order of (step in radians /
    // cosine)^2: (0.01 / 600 / 0.1)^2 = 3e-8.
    const double e = 0.01;
    const auto change = [&](glm::dvec2 d) {
      return (back_projected(splat, plane->centre + e * d) -
              back_projected(splat, plane->centre - e * d)) /
             (2.0 * e);
    };
    const glm::dvec3 d0 = change({1, 0});
    const glm::dvec3 d1 = change({0, 1});
    // The plane's basis is arbitrary: lengths and angles are what J^-1 has to have right.
    const glm::dmat2 gram = glm::transpose(plane->to_plane) * plane->to_plane;
    const double size = glm::length(d0) + glm::length(d1);
    EXPECT_NEAR(gram[0][0], glm::dot(d0, d0), 1e-6 * size * size);
    EXPECT_NEAR(gram[0][1], glm::dot(d0, d1), 1e-6 * size * size);
    EXPECT_NEAR(gram[1][1], glm::dot(d1, d1), 1e-6 * size * size);
    const glm::dmat2 identity = plane->to_pixels * plane->to_plane;
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(identity[i / 2][i % 2], i % 3 == 0 ? 1.0 : 0.0, 1e-12);
    EXPECT_NEAR(plane->area * glm::length(glm::cross(d0, d1)), 1.0, 1e-6);
  }
}

TEST(ResamplingFilter, ScreenSpaceAndSourceSpaceAgree) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Splat& splat : random_splats(500)) {
    const auto plane = map_tangent_plane(kMapping, splat.point, splat.normal);
    ASSERT_TRUE(plane);
    const auto screen = screen_kernel(*plane, splat.radius, EwaFilter::Ewa, 4.0);
    const auto source = source_kernel(*plane, splat.radius, 4.0);
    ASSERT_TRUE(screen && source);
    EXPECT_NEAR(source->extent.x, screen->extent.x, 1e-9 * screen->extent.x);
    EXPECT_NEAR(source->extent.y, screen->extent.y, 1e-9 * screen->extent.y);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec2 pixel =
          screen->centre + screen->extent * glm::dvec2(unit(random), unit(random));
      const double seven = screen->peak * std::exp(-screen->exponent(pixel));
      const double eight = source->peak * std::exp(-source->exponent(pixel));
      EXPECT_NEAR(eight, seven, 1e-9 * seven);
    }
  }
}

template <class Kernel>
double sum_over_pixels(const Kernel& kernel, double cutoff) {
  double sum = 0.0;
  const glm::dvec2 low = glm::floor(kernel.centre - kernel.extent) - 1.0;
  const glm::dvec2 high = kernel.centre + kernel.extent + 1.0;
  for (double y = low.y + 0.5; y <= high.y; ++y) {
    for (double x = low.x + 0.5; x <= high.x; ++x) {
      const double exponent = kernel.exponent({x, y});
      if (exponent < cutoff) sum += kernel.peak * std::exp(-exponent);
    }
  }
  return sum;
}

TEST(ResamplingFilter, KernelsSumUpToTheAreaThatThePointStandsFor) {
  // The integral of |J| G_V h^2 is h^2 |J|, less the part e^-c beyond the cutoff. A sum over unit
  // pixels differs from the integral of a Gaussian of variance 1 or more by at most 4 exp(-2 pi^2)
  // = 1.1e-8 of it; e^-20 is 2e-9.
  for (const Splat& splat : random_splats(60)) {
    const auto plane = map_tangent_plane(kMapping, splat.point, splat.normal);
    ASSERT_TRUE(plane);
    const double area = splat.radius * splat.radius * plane->area;
    for (const EwaFilter filter : {EwaFilter::Ewa, EwaFilter::Circular}) {
      const auto kernel = screen_kernel(*plane, splat.radius, filter, 20.0);
      ASSERT_TRUE(kernel);
      EXPECT_NEAR(sum_over_pixels(*kernel, 20.0), area, 2e-8 * area);
    }
    const auto source = source_kernel(*plane, splat.radius, 20.0);
    ASSERT_TRUE(source);
    EXPECT_NEAR(sum_over_pixels(*source, 20.0), area, 2e-8 * area);
  }
}

TEST(ResamplingFilter, CutoffTakesAwayWhatTheoryStates) {
  // A round kernel of 50 pixels: its rim, at exp(-c) of the peak, passes 2 pi 70 pixels, each of
  // which is in or out by chance: about sqrt(440) / (2 pi 50^2) e^-1 = 5e-4 of the sum.
  const Splat splat{{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 50.0 / kMapping.scale};
  const auto plane = map_tangent_plane(kMapping, splat.point, splat.normal);
  ASSERT_TRUE(plane);
  const auto kernel = screen_kernel(*plane, splat.radius, EwaFilter::Ewa, 1.0);
  ASSERT_TRUE(kernel);
  EXPECT_NEAR(sum_over_pixels(*kernel, 1.0) / 2500.0, 1.0 - std::exp(-1.0), 2e-3);
}

TEST(ResamplingFilter, CircleHasTheMajorAxisOfTheEllipse) {
  // Tilted by 60 degrees about y, h = 8 pixels: 8 along y, 4 along x, and the low-pass filter.
  const double h = 8.0 / kMapping.scale;
  const glm::dvec3 normal(std::sqrt(0.75), 0.0, -0.5);
  const auto plane = map_tangent_plane(kMapping, {0.0, 0.0, 1.0}, normal);
  ASSERT_TRUE(plane);
  const auto ellipse = screen_kernel(*plane, h, EwaFilter::Ewa, 1.0);
  const auto circle = screen_kernel(*plane, h, EwaFilter::Circular, 1.0);
  const auto unfiltered = screen_kernel(*plane, h, EwaFilter::Unfiltered, 1.0);
  ASSERT_TRUE(ellipse && circle && unfiltered);
  // Double arithmetic on numbers of the order of 10.
  const double rounding = 1e-12;
  EXPECT_NEAR(ellipse->extent.x, std::sqrt(2.0 * (16.0 + 1.0)), rounding);
  EXPECT_NEAR(ellipse->extent.y, std::sqrt(2.0 * (64.0 + 1.0)), rounding);
  EXPECT_NEAR(circle->extent.x, ellipse->extent.y, rounding);
  EXPECT_NEAR(circle->extent.y, ellipse->extent.y, rounding);
  EXPECT_NEAR(unfiltered->extent.x, std::sqrt(2.0) * 4.0, rounding);
  EXPECT_NEAR(unfiltered->extent.y, std::sqrt(2.0) * 8.0, rounding);
}

TEST(ResamplingFilter, UnfilteredPointBelowAPixelFallsOnItsPixel) {
  const auto plane = map_tangent_plane(kMapping, {0.3333, 0.1234, 1.0}, {0.0, 0.0, -1.0});
  ASSERT_TRUE(plane);
  const auto kernel = screen_kernel(*plane, 0.05 / kMapping.scale, EwaFilter::Unfiltered, 1.0);
  ASSERT_TRUE(kernel);
  EXPECT_EQ(kernel->centre, glm::floor(plane->centre) + 0.5);
  EXPECT_EQ(kernel->exponent(kernel->centre), 0.0);
  EXPECT_NEAR(kernel->peak, 0.5 / std::acos(-1.0), 1e-12);  // of every Gaussian, times h^2 |J|
}

TEST(ResamplingFilter, PlanesSeenEdgeOnAndPointsWithoutAreaHaveNoKernel) {
  const glm::dvec3 point(0.0, 0.0, 1.0);
  EXPECT_FALSE(map_tangent_plane(kMapping, point, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(map_tangent_plane(kMapping, point, glm::dvec3(std::nan(""))));
  const auto plane = map_tangent_plane(kMapping, point, {0.0, 0.0, 1.0});
  ASSERT_TRUE(plane);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double radius : {0.0, 1e-200, std::nan(""), infinity, 1e200}) {
    for (const EwaFilter filter : {EwaFilter::Ewa, EwaFilter::Circular, EwaFilter::Unfiltered})
      EXPECT_FALSE(screen_kernel(*plane, radius, filter, 1.0)) << radius;
    EXPECT_FALSE(source_kernel(*plane, radius, 1.0)) << radius;
  }
}

}  // namespace
}  // namespace relief::ewa
