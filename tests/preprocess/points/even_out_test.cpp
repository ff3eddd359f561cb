// Points that lie in lines are merged until they are about as far apart along the lines as across.
#include "preprocess/points/even_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "preprocess/points/sampling.h"
#include "tests/preprocess/noise/noisy_surfaces.h"

namespace relief {
namespace {

std::uint64_t even(Points& points) {
  Progress progress;
  return even_out(points, progress);
}

/// A square of scan lines along X, from 0 to 1; points along a line are `ratio` times as dense as
/// lines, whose distance is 1 / lines. `noise` is along Z, in distances of lines.
Points scan_lines(int lines, int ratio, double noise, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::normal_distribution<double> height(0.0, noise / lines);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Points points;
  for (int line = 0; line < lines; ++line) {
    const double start = any(random);
    for (int i = 0; i < lines * ratio; ++i) {
      points.positions.emplace_back((i + start) / (lines * ratio), (line + 0.5) / lines,
                                    noise > 0.0 ? height(random) : 0.0);
    }
  }
  return points;
}

TEST(EvenOut, MergesAlongScanLines) {
  const int lines = 40;
  for (const int ratio : {6, 10, 30}) {
    // Noise of 0.3 hides lines in strips, which are surfaces to the nearest neighbours.
    for (const double noise : {0.0, 0.02, 0.3}) {
      Points points = scan_lines(lines, ratio, noise);
      const std::uint64_t before = points.size();
      const std::uint64_t merged = even(points);
      EXPECT_EQ(merged + points.size(), before);
      // About 2 points a distance of lines, more where strips are as thick as they are far apart.
      EXPECT_GT(points.size(), 1.2 * lines * lines) << ratio << " " << noise;
      EXPECT_LT(points.size(), (noise > 0.1 ? 5.0 : 3.0) * lines * lines) << ratio << " " << noise;
      if (noise > 0.1) continue;  // strips are left that look like lines here and there
      Progress progress;
      EXPECT_EQ(sampling_of(points.positions, progress).scale, 0U) << ratio << " " << noise;
    }
  }
}

// Few points, whose lines are longer than the neighbourhoods that are looked at.
TEST(EvenOut, LeavesSmallScans) {
  for (const int count : {20, 100, 200, 900}) {
    Points points;
    for (int i = 0; i < count; ++i) points.positions.emplace_back(0.01 * (i % 100), i / 100, 0);
    EXPECT_EQ(even(points), 0U) << count;
  }
}

// A spinning scanner that stood still for 20 turns: to see the surface takes some 400 points.
TEST(EvenOut, MergesFramesOfScanLines) {
  const int lines = 40;
  Points points;
  for (int frame = 0; frame < 20; ++frame) {
    const Points more = scan_lines(lines, 10, 0.05, frame);
    points.positions.insert(points.positions.end(), more.positions.begin(), more.positions.end());
  }
  even(points);
  EXPECT_GT(points.size(), 1.2 * lines * lines);
  EXPECT_LT(points.size(), 4.0 * lines * lines);
  Progress progress;
  EXPECT_EQ(sampling_of(points.positions, progress).scale, 0U);
}

TEST(EvenOut, MergesRaysThatWereMeasuredManyTimes) {
  const auto scan = test::random_sphere(2'000);
  for (const int times : {4, 20}) {
    for (const double noise : {1e-9, 0.01}) {
      std::mt19937 random(3);
      std::normal_distribution<double> along(0.0, noise * scan.spacing);
      Points points;
      for (const glm::dvec3& ray : scan.positions) {
        for (int k = 0; k < times; ++k) points.positions.push_back(ray * (1.0 + along(random)));
      }
      EXPECT_GT(even(points), 0U);
      // At random, one ray in eight has another within 0.44 spacings or less, and is merged too.
      EXPECT_LT(points.size(), 2'050U) << times << " " << noise;
      EXPECT_GT(points.size(), 1'200U) << times << " " << noise;
      double rms = 0.0;
      for (const glm::dvec3& p : points.positions) rms += std::pow(glm::length(p) - 1.0, 2);
      rms = std::sqrt(rms / static_cast<double>(points.size()));
      // Chords of merged rays lie inside the sphere by the square of a spacing.
      EXPECT_LT(rms, noise * scan.spacing + 0.2 * scan.spacing * scan.spacing);
    }
  }
}

TEST(EvenOut, LeavesOrdinaryScansAsTheyAre) {
  std::vector<std::vector<glm::dvec3>> scans{
      test::random_plane(5'000).positions, test::random_sphere(5'000).positions,
      test::random_cube(5'000).positions, scan_lines(60, 1, 0.0).positions,
      scan_lines(60, 3, 0.02).positions};
  for (const double noise : {0.25, 1.0, 2.0})
    scans.push_back(test::with_noise(test::random_sphere(5'000), noise));
  for (const auto& positions : scans) {
    Points points;
    points.positions = positions;
    EXPECT_EQ(even(points), 0U);
    EXPECT_EQ(points.positions, positions);
  }
}

// A slanted wall in a depth image whose depths are in steps 8 pixels wide and 15 deep. The nearest
// neighbours lie on one step, and more turn their plane by 62 degrees; but pixels are no noise.
TEST(EvenOut, LeavesTheStepsOfDepthImages) {
  Points points;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) points.positions.emplace_back(x, y, 15.0 * std::floor(x / 8.0));
  }
  EXPECT_EQ(even(points), 0U);
}

// A cable beside scan lines is a line at all scales.
TEST(EvenOut, LeavesCables) {
  Points points = scan_lines(60, 10, 0.0);
  const std::size_t ground = points.size();
  for (int i = 0; i < 600; ++i) points.positions.emplace_back(i / 600.0, 0.5, 1.0);
  even(points);
  EXPECT_LT(points.size(), ground / 2);
  const auto is_cable = [](glm::dvec3 p) { return p.z > 0.5; };
  EXPECT_EQ(std::ranges::count_if(points.positions, is_cable), 600);
}

TEST(EvenOut, AveragesAttributes) {
  Points points;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int k = 0; k < 10; ++k) {
        points.positions.emplace_back(x, y, 1e-6 * k);
        points.colours.emplace_back(k % 2 == 0 ? 255 : 0, 0, 255);
        points.normals.emplace_back(k % 2 == 0 ? 1.0F : -1.0F, 0.0F, 1.0F);
      }
    }
  }
  EXPECT_EQ(even(points), 40U * 40U * 9U);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points.positions[i].z, 4.5e-6, 1e-12);
    EXPECT_EQ(points.colours[i], glm::u8vec3(188, 0, 255));  // half the light
    EXPECT_EQ(points.normals[i].x, 0.0F);
    EXPECT_GT(points.normals[i].z, 0.0F);
  }
}

// The two sides of a thin sheet, each measured five times.
TEST(EvenOut, KeepsPointsApartWhoseNormalsOppose) {
  Points points;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      for (int k = 0; k < 10; ++k) {
        const double side = k % 2 == 0 ? 1.0 : -1.0;
        points.positions.emplace_back(x, y, 0.01 * side + 1e-6 * k);
        points.normals.emplace_back(0.0F, 0.0F, static_cast<float>(side));
      }
    }
  }
  EXPECT_EQ(even(points), 40U * 40U * 8U);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_GT(points.positions[i].z * points.normals[i].z, 0.0);
}

}  // namespace
}  // namespace relief
