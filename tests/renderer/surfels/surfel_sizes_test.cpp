// Sizes of surfels from points alone ([Textured surfels], section 3.3).
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <random>

#include "renderer/surfels/surfel_triangle.h"
#include "renderer/surfels/surfels.h"
#include "renderer/surfels/triangle_clusters.h"
#include "tests/renderer/surfels/disc_coverage.h"
#include "tests/renderer/surfels/sampled_surfaces.h"

namespace relief {
namespace {

constexpr SurfelSize kMethods[] = {SurfelSize::BspEdge, SurfelSize::BspCircle, SurfelSize::Qsplat,
                                   SurfelSize::Cell};

SurfelSizes must_find(std::span<const glm::dvec3> positions, SurfelSize method) {
  Progress progress;
  auto sizes = find_surfel_sizes(positions, {}, method, progress);
  if (sizes) return std::move(*sizes);
  ADD_FAILURE() << sizes.error().message;
  return {};
}

/// Sizes that are numbers above 0, at most `most`.
void expect_bounded(std::span<const glm::dvec3> positions, double most) {
  for (const SurfelSize method : kMethods) {
    const SurfelSizes sizes = must_find(positions, method);
    ASSERT_EQ(sizes.diameters.size(), positions.size());
    for (const double d : sizes.diameters) {
      ASSERT_GT(d, 0.0);
      ASSERT_LE(d, most);
    }
  }
}

TEST(SurfelTriangle, HasTheEigenvaluesOfItsCorners) {
  // Half the covariance of the corners (-1, 0), (1, 0), (0, h) lies along x: 2; along y: 2 h^2 / 3.
  for (const double h : {0.1, 0.5, 1.0}) {
    const SurfelTriangle triangle({-1, 0, 5}, {1, 0, 5}, {0, h, 5});
    EXPECT_NEAR(triangle.eigenvalue_ratio(), h * h / 3.0, 1e-12);
  }
  const double height = std::sqrt(3.0) / 2.0;
  const SurfelTriangle equal({0, 0, 0}, {1, 0, 0}, {0.5, height, 0});
  EXPECT_NEAR(equal.eigenvalue_ratio(), 1.0, 1e-7) << "a square root of rounding";
  EXPECT_NEAR(equal.mean_edge(), 1.0, 1e-15);
  EXPECT_NEAR(equal.circle_diameter(), 2.0 / std::sqrt(3.0), 1e-15) << "0.577 a is the radius";
  EXPECT_TRUE(SurfelTriangle({0, 0, 0}, {1, 1, 1}, {3, 3, 3}).is_collinear());
  EXPECT_TRUE(SurfelTriangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}).is_collinear());
}

TEST(SurfelSizes, ThreePointsAreOneTriangle) {
  const std::vector<glm::dvec3> points{{7, 0, 0}, {10, 0, 0}, {7, 4, 0}};
  for (const double d : must_find(points, SurfelSize::BspEdge).diameters)
    EXPECT_NEAR(d, (3.0 + 4.0 + 5.0) / 3.0, 1e-12);
  const SurfelSizes circle = must_find(points, SurfelSize::BspCircle);
  for (const double d : circle.diameters) EXPECT_NEAR(d, 5.0, 1e-12) << "Thales";
  EXPECT_EQ(circle.triangles, 1U);
  EXPECT_EQ(circle.leftovers, 0U);
  // Each has both others among its nearest; the longest edge at it.
  const std::vector<double> qsplat = must_find(points, SurfelSize::Qsplat).diameters;
  EXPECT_NEAR(qsplat[0], 4.0, 1e-12);
  EXPECT_NEAR(qsplat[1], 5.0, 1e-12);
}

// Three groups along x: the plane through the centroid would cut the middle one, and is moved past
// one point at most.
TEST(SurfelSizes, ClustersFollowTheGreatestVariation) {
  std::vector<glm::dvec3> points;
  for (int group = 0; group < 3; ++group) {
    for (int k = 0; k < 3; ++k)
      points.emplace_back(10.0 * group + (k == 1 ? 0.5 : 0.0), 0.8 * k, 0.0);
  }
  const SurfelSizes sizes = must_find(points, SurfelSize::BspEdge);
  EXPECT_EQ(sizes.triangles, 3U);
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_EQ(sizes.clusters[k], sizes.clusters[k / 3 * 3]);
  EXPECT_NE(sizes.clusters[0], sizes.clusters[3]);
  EXPECT_NE(sizes.clusters[3], sizes.clusters[6]);
}

TEST(SurfelSizes, AllClustersButOneHaveThreePoints) {
  for (const std::size_t count : {4U, 5U, 6U, 7U, 8U, 100U, 3001U, 20000U}) {
    auto points =
        test::sample_surface(test::Shape::Torus, test::Sampling::Random, count, 3).positions;
    Progress progress;
    const auto clusters = find_triangle_clusters(points, progress);
    ASSERT_TRUE(clusters);
    std::map<std::size_t, std::size_t> by_size;
    for (std::size_t c = 0; c < clusters->size(); ++c) ++by_size[clusters->of(c).size()];
    EXPECT_EQ(by_size[3], count / 3) << count;
    EXPECT_EQ(clusters->size(), (count + 2) / 3) << count;
    std::vector<std::uint32_t> order = clusters->order;
    std::ranges::sort(order);
    for (std::uint32_t k = 0; k < order.size(); ++k) ASSERT_EQ(order[k], k);
  }
}

TEST(SurfelSizes, LeftoversHaveTrianglesOfTheirNeighbours) {
  // The fourth point is alone; its nearest triangle is with the two that are 1 and 2 away.
  const std::vector<glm::dvec3> points{{0, 0, 0}, {0, 1, 0}, {3, 0, 0}, {4, 0.5, 0}};
  const SurfelSizes sizes = must_find(points, SurfelSize::BspEdge);
  EXPECT_EQ(sizes.triangles, 1U);
  EXPECT_EQ(sizes.leftovers, 1U);
  std::size_t alone = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (std::ranges::count(sizes.clusters, sizes.clusters[k]) == 1) alone = k;
  }
  std::vector<double> best;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (a != alone && b != alone)
        best.push_back(SurfelTriangle(points[alone], points[a], points[b]).mean_edge());
    }
  }
  EXPECT_TRUE(std::ranges::any_of(
      best, [&](double edge) { return std::abs(edge - sizes.diameters[alone]) < 1e-12; }));
}

TEST(SurfelSizes, CollinearPointsAreLeftovers) {
  std::vector<glm::dvec3> line;
  for (int k = 0; k < 300; ++k) line.emplace_back(k, 2.0 * k, 0.0);
  const double step = std::sqrt(5.0);
  const SurfelSizes edge = must_find(line, SurfelSize::BspEdge);
  EXPECT_EQ(edge.triangles, 0U);
  EXPECT_EQ(edge.leftovers, 300U);
  EXPECT_NEAR(edge.diameters[150], step, 1e-9) << "the mean distance of the two nearest";
  EXPECT_NEAR(edge.diameters[0], 1.5 * step, 1e-9);
  EXPECT_NEAR(must_find(line, SurfelSize::BspCircle).diameters[0], 2.0 * step, 1e-9);
}

TEST(SurfelSizes, DuplicatesHaveOneSize) {
  auto surface =
      test::sample_surface(test::Shape::Plane, test::Sampling::Jittered, 300, 1).positions;
  const std::size_t once = surface.size();
  for (const SurfelSize method : kMethods) {
    const std::vector<double> alone = must_find(surface, method).diameters;
    std::vector<glm::dvec3> doubled = surface;
    for (int copy = 0; copy < 30; ++copy) doubled.push_back(surface[17]);
    doubled.insert(doubled.end(), surface.begin(), surface.end());
    const std::vector<double> sizes = must_find(doubled, method).diameters;
    for (std::size_t k = 0; k < once; ++k) {
      EXPECT_EQ(sizes[k], alone[k]);
      EXPECT_EQ(sizes[once + 30 + k], alone[k]);
    }
    EXPECT_EQ(sizes[once], alone[17]);
  }
}

TEST(SurfelSizes, AreBoundedForAnyInput) {
  expect_bounded({}, 0.0);
  const std::vector<glm::dvec3> one(1, glm::dvec3(3, 4, 5));
  expect_bounded(one, 1.0);
  const std::vector<glm::dvec3> same(1000, glm::dvec3(3, 4, 5));
  expect_bounded(same, 1.0);
  const std::vector<glm::dvec3> two{{0, 0, 0}, {1, 0, 0}};
  expect_bounded(two, 2.0);  // a cell ends at the other
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<glm::dvec3> bad{
      {kNaN, 0, 0}, {0, 0, 0}, {kInfinity, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expect_bounded(bad, 2.0 * std::sqrt(2.0) + 1e-12);
  const std::vector<glm::dvec3> nothing(9, glm::dvec3(kNaN));
  expect_bounded(nothing, 1.0);
  // Their extent's square overflows, and that of the other's vanishes.
  const std::vector<glm::dvec3> huge{{-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0}, {0, 0, 1e308}};
  expect_bounded(huge, std::numeric_limits<double>::max());
  const std::vector<glm::dvec3> tiny{{0, 0, 0}, {1e-300, 0, 0}, {0, 1e-300, 0}, {0, 0, 3e-300}};
  expect_bounded(tiny, 1e-299);
  // Ever nearer to a corner: each plane through a centroid would leave but a few points on one
  // side.
  std::vector<glm::dvec3> nearer;
  for (int k = 0; k < 20000; ++k) {
    const double size = std::exp2(-0.05 * k);
    nearer.emplace_back(size, size * ((k * 7) % 11) / 11.0, size * ((k * 3) % 5) / 5.0);
  }
  // A triangle's circle is at most three times its longest edge, which the cube's diagonal
  // bounds.
  expect_bounded(nearer, 2.0 * std::sqrt(3.0) * 3.0);
}

TEST(SurfelSizes, DoNotDependOnThreads) {
  auto surface = test::sample_surface(test::Shape::Torus, test::Sampling::Random, 30000, 5);
  for (const SurfelSize method : kMethods) {
    const SurfelSizes many = must_find(surface.positions, method);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const SurfelSizes one = must_find(surface.positions, method);
    EXPECT_EQ(many.diameters, one.diameters);
    EXPECT_EQ(many.clusters, one.clusters);
  }
}

TEST(SurfelSizes, CanBeInterrupted) {
  class Cancelled final : public Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } progress;
  const auto points =
      test::sample_surface(test::Shape::Plane, test::Sampling::Random, 10000, 1).positions;
  for (const SurfelSize method : kMethods)
    EXPECT_FALSE(find_surfel_sizes(points, {}, method, progress));
}

}  // namespace
}  // namespace relief
