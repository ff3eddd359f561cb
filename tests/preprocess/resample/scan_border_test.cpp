// Where scans end, and patches with them.
#include "preprocess/resample/borders/scan_border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "preprocess/resample/resample.h"
#include "tests/preprocess/prepared.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr std::uint32_t kNoOthers = std::numeric_limits<std::uint32_t>::max();

/// Random points, one for each square of the plane of side 1, where `inside` says so.
Points scatter(double half, unsigned seed, const std::function<bool(double, double)>& inside) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-half, half);
  Points points;
  for (int n = 0; n < static_cast<int>(4.0 * half * half); ++n) {
    const double x = place(random);
    const double y = place(random);
    if (!inside(x, y)) continue;
    points.positions.emplace_back(x, y, 0.0);
    points.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  return points;
}

/// Distances to a circle, negative within, of the nodes beside holes of a flat scan's patches.
std::vector<double> rims(const test::Prepared& scan, const ScanBorder* border, double radius) {
  const std::vector<Region> regions = scan.regions(70.0);
  const Membership membership = membership_of(scan.samples(), regions);
  std::vector<Patch> patches;
  for (const Region& region : regions) {
    patches.push_back(resample_region({.samples = scan.samples(),
                                       .graph = scan.graph,
                                       .membership = membership,
                                       .colours = scan.points.colours,
                                       .border = border},
                                      region, {.spacing = 0.8, .height_step = 0.01}));
  }
  std::vector<double> found;
  for (const Patch& patch : patches) {
    const auto is_sample = [&](std::uint32_t i, std::uint32_t j) {
      return i < patch.width && j < patch.height && patch.at(i, j) != kHole;
    };
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        const bool rim = is_sample(i, j) && !(is_sample(i - 1, j) && is_sample(i + 1, j) &&
                                              is_sample(i, j - 1) && is_sample(i, j + 1));
        if (rim) found.push_back(glm::length(position_of(patch, i, j)) - radius);
      }
    }
  }
  return found;
}

TEST(ScanBorder, IsFoundAndTellsHowFarAway) {
  const test::Prepared scan(
      scatter(32.0, 3, [](double x, double y) { return std::hypot(x, y) < 30.0; }));
  const ScanBorder border(scan.samples(), scan.graph, kNoOthers);
  ASSERT_FALSE(border.empty());
  double squares = 0.0;
  constexpr int kPlaces = 200;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kPlaces;
    const glm::dvec3 outward(std::cos(angle), std::sin(angle), 0.0);
    for (const double off : {-0.7, 0.0, 0.7}) {
      const auto beyond = border.beyond((30.0 + off) * outward, {0.0F, 0.0F, 1.0F}, 1.0);
      ASSERT_TRUE(beyond) << angle;
      squares += (*beyond - off) * (*beyond - off);
    }
  }
  // Between a random scan's last points nothing tells where its surface ends to better than some
  // tenths of a spacing.
  EXPECT_LT(std::sqrt(squares / (3 * kPlaces)), 0.35);
  EXPECT_FALSE(border.beyond({0.0, 0.0, 0.0}, {0.0F, 0.0F, 1.0F}, 1.0));
  EXPECT_FALSE(border.beyond({30.0, 0.0, 5.0}, {0.0F, 0.0F, 1.0F}, 1.0)) << "another sheet";
  EXPECT_FALSE(border.beyond({30.0, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}, 1.0)) << "another side";
}

/// Mean and standard deviation.
std::pair<double, double> spread(const std::vector<double>& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return {sum / count, std::sqrt(squares / count - sum * sum / (count * count))};
}

TEST(ScanBorder, RaggedRimsBecomeCurves) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const test::Prepared scan(
        scatter(32.0, seed, [](double x, double y) { return std::hypot(x, y) < 30.0; }));
    const ScanBorder border(scan.samples(), scan.graph, kNoOthers);
    const auto [mean, deviation] = spread(rims(scan, &border, 30.0));
    const auto [mean_before, deviation_before] = spread(rims(scan, nullptr, 30.0));
    // Nodes beside holes lie up to a cell of 0.8 before the border.
    EXPECT_NEAR(mean, -0.4, 0.2);
    EXPECT_LT(deviation, 0.85 * deviation_before) << mean_before;
  }
}

TEST(ScanBorder, HolesStayOpen) {
  const test::Prepared scan(
      scatter(20.0, 4, [](double x, double y) { return std::hypot(x, y) > 6.0; }));
  const ScanBorder border(scan.samples(), scan.graph, kNoOthers);
  std::size_t about_hole = 0;
  for (const double off : rims(scan, &border, 6.0)) {
    if (off > 6.0) continue;
    EXPECT_GT(off, -1.2);
    ++about_hole;
  }
  EXPECT_GE(about_hole, 30U);
}

// Its points' nearest ones are all on their side.
TEST(ScanBorder, ADensePartInASparseOneHasNone) {
  Points points = scatter(40.0, 6, [](double x, double y) { return std::hypot(x, y) >= 10.0; });
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  for (int n = 0; n < 40000; ++n) {
    const double x = place(random);
    const double y = place(random);
    if (std::hypot(x, y) >= 10.0) continue;
    points.positions.emplace_back(x, y, 0.0);
    points.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  const test::Prepared scan(std::move(points));
  const ScanBorder border(scan.samples(), scan.graph, kNoOthers);
  int found = 0;
  for (int k = 0; k < 200; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 200;
    const glm::dvec3 at(10.0 * std::cos(angle), 10.0 * std::sin(angle), 0.0);
    found += border.beyond(at, {0.0F, 0.0F, 1.0F}, 0.1) ? 1 : 0;
  }
  // Of 200 places about the dense part 182 were before.
  EXPECT_LE(found, 10);
}

TEST(ScanBorder, CornersStay) {
  // A regular grid of 41x41 points ends half a spacing beyond its last rows.
  Points points;
  for (int y = -20; y <= 20; ++y) {
    for (int x = -20; x <= 20; ++x) {
      points.positions.emplace_back(x, y, 0.0);
      points.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  const test::Prepared scan(std::move(points));
  const ScanBorder border(scan.samples(), scan.graph, kNoOthers);
  const auto beyond = [&](double x, double y) {
    return border.beyond({x, y, 0.0}, {0.0F, 0.0F, 1.0F}, scan.graph.spacing[0]).value_or(-9.0);
  };
  EXPECT_LT(beyond(20.0, 0.0), 0.0);
  EXPECT_GT(beyond(20.8, 0.0), 0.0);
  EXPECT_LT(beyond(20.0, 20.0), 0.0) << "the corner is a sample";
  EXPECT_GT(beyond(20.8, 20.8), 0.0);
  EXPECT_GT(beyond(20.8, 17.0), 0.0) << "the other side of the corner does not count";
}

TEST(ScanBorder, ClosedSurfacesAndWiresHaveNone) {
  const test::Prepared sphere(test::sample_sphere(6000));
  const ScanBorder none(sphere.samples(), sphere.graph, kNoOthers);
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    EXPECT_FALSE(
        none.beyond(sphere.points.positions[i], sphere.points.normals[i], sphere.graph.spacing[i]));
  }
  Points wire;
  for (int x = 0; x < 200; ++x) {
    wire.positions.emplace_back(x, 0.01 * (x % 3), 0.0);
    wire.normals.emplace_back(0.0F, 0.0F, 1.0F);
  }
  const test::Prepared line(std::move(wire));
  EXPECT_FALSE(ScanBorder(line.samples(), line.graph, kNoOthers)
                   .beyond({100.0, 0.5, 0.0}, {0.0F, 0.0F, 1.0F}, 1.0));
}

TEST(ScanBorder, StepsOfDepthAreNone) {
  // A wall seen askew by a camera whose depths are in steps: strips of three columns that face it,
  // each four spacings behind the one before.
  Points points;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      points.positions.emplace_back(x, y, 4.0 * (x / 3));
      points.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  const test::Prepared scan(std::move(points));
  const ScanBorder border(scan.samples(), scan.graph, kNoOthers);
  for (int y = 12; y < 48; ++y) {
    for (int x = 12; x < 48; ++x) {
      EXPECT_FALSE(border.beyond({x, y, 4.0 * (x / 3)}, {0.0F, 0.0F, 1.0F}, 1.0)) << x << " " << y;
    }
  }
}

TEST(ScanBorder, PointsOfOtherTilesAreNone) {
  const test::Prepared scan(scatter(20.0, 5, [](double, double) { return true; }));
  EXPECT_TRUE(ScanBorder(scan.samples(), scan.graph, 0).empty());
}

}  // namespace
}  // namespace relief
