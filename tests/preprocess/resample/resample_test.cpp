#include "preprocess/resample/resample.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>
#include <limits>
#include <numeric>
#include <tuple>

#include "common/octahedral.h"
#include "preprocess/measure/measure.h"
#include "preprocess/resample/attributes/attributes.h"
#include "tests/preprocess/prepared.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr double kStep = 0.02;

// A scan with its regions under a cone of 70 degrees.
struct Partitioned : test::Prepared {
  explicit Partitioned(Points scan) : Prepared(std::move(scan)), regions(Prepared::regions(70.0)) {}

  [[nodiscard]] std::vector<Patch> patches(const ResampleOptions& options) const {
    std::vector<Patch> out;
    const Membership membership = membership_of(samples(), regions);
    for (const Region& region : regions) {
      out.push_back(resample_region({.samples = samples(),
                                     .graph = graph,
                                     .membership = membership,
                                     .colours = points.colours},
                                    region, options));
    }
    return out;
  }

  std::vector<Region> regions;
};

struct Deviation {
  double distance = 0.0;       // largest, world units
  double angle_degrees = 0.0;  // largest
};

// Margin nodes steeper than this (75 degrees, 5 more than the tests' cone) are not looked at: a
// cell there spans four times its size on the surface, the fits are one-sided, and what other
// patches have there lies in front or is the same.
constexpr double kRimCosine = 0.2588;

template <class Surface>
Deviation worst_deviation(const std::vector<Patch>& patches, const Surface& surface) {
  Deviation worst;
  for (const Patch& patch : patches) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const glm::dvec3 p = position_of(patch, i, j);
        const glm::vec3 local =
            unit_from_snorm16(patch.normals.texels[std::size_t{j} * patch.width + i]);
        const glm::dvec3 n = patch.axes * glm::dvec3(local);
        if (glm::dot(surface.normal(p), patch.axes[2]) < kRimCosine) continue;
        worst.distance = std::max(worst.distance, std::abs(surface.distance(p)));
        worst.angle_degrees = std::max(
            worst.angle_degrees, std::acos(std::clamp(glm::dot(n, surface.normal(p)), -1.0, 1.0)) *
                                     180.0 / std::numbers::pi);
      }
    }
  }
  return worst;
}

ResampleOptions options_for(double spacing) {
  return {spacing, spacing / 20.0, 1, 1, false};
}

TEST(Resample, PutsSamplesOnTheSphere) {
  const Partitioned scan(test::sample_sphere(8000));
  const double spacing = std::sqrt(4.0 * std::numbers::pi / 8000.0);
  const Deviation worst = worst_deviation(scan.patches(options_for(spacing)), test::Sphere{});
  // Rounding contributes spacing / 40; the fits may add as much again at one-sided borders.
  EXPECT_LT(worst.distance, spacing / 10.0);
  EXPECT_LT(worst.angle_degrees, 3.0);
}

TEST(Resample, PutsSamplesOnTheTorus) {
  const test::Torus torus;
  const Partitioned scan(test::sample_torus(torus, kStep));
  const Deviation worst = worst_deviation(scan.patches(options_for(kStep)), torus);
  EXPECT_LT(worst.distance, kStep / 10.0);
  // Points are 3 degrees apart around the tube; at the steep rims of patches a cell spans three
  // times that, and the fits there are one-sided.
  EXPECT_LT(worst.angle_degrees, 3.0);
}

TEST(Resample, PutsSamplesOnTheSaddle) {
  const test::Saddle saddle;
  const Partitioned scan(test::sample_height_field(
      0.5, kStep, [&](double x, double y) { return saddle.height(x, y); }));
  const Deviation worst = worst_deviation(scan.patches(options_for(kStep)), saddle);
  EXPECT_LT(worst.distance, kStep / 10.0);
  EXPECT_LT(worst.angle_degrees, 3.0);
}

TEST(Resample, KeepsToTheBorderOfAnOpenScan) {
  const Partitioned scan(test::sample_height_field(0.5, kStep, [](double, double) { return 0.0; }));
  glm::dvec2 low(1.0);
  glm::dvec2 high(-1.0);
  for (const glm::dvec3& p : scan.points.positions) {
    low = glm::min(low, glm::dvec2(p));
    high = glm::max(high, glm::dvec2(p));
  }
  for (const Patch& patch : scan.patches(options_for(kStep))) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const glm::dvec3 p = position_of(patch, i, j);
        EXPECT_GT(p.x, low.x - kStep);
        EXPECT_GT(p.y, low.y - kStep);
        EXPECT_LT(p.x, high.x + kStep);
        EXPECT_LT(p.y, high.y + kStep);
      }
    }
  }
}

TEST(Resample, LeavesGapsOfTheScanOpen) {
  Points points = test::sample_height_field(0.5, kStep, [](double, double) { return 0.0; });
  constexpr double kGap = 0.12;  // six spacings across
  std::erase_if(points.positions, [](glm::dvec3 p) { return std::hypot(p.x, p.y) < kGap / 2.0; });
  const Partitioned scan(std::move(points));
  std::size_t samples = 0;
  for (const Patch& patch : scan.patches(options_for(kStep))) {
    samples += count_samples(patch);
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const glm::dvec3 p = position_of(patch, i, j);
        EXPECT_GT(std::hypot(p.x, p.y), kGap / 2.0 - kStep);
      }
    }
  }
  EXPECT_GT(samples, scan.points.size() * 9 / 10);
}

TEST(Resample, ClosesSparseSpotsOfAnUnevenScan) {
  // Left half dense, right half three times sparser: the grid follows the dense one, and still the
  // sparse half has no holes.
  Points points = test::sample_height_field(0.5, kStep, [](double, double) { return 0.0; });
  std::erase_if(points.positions, [](glm::dvec3 p) { return p.x > 0.0; });
  for (const glm::dvec3& p :
       test::sample_height_field(0.5, 3.0 * kStep, [](double, double) { return 0.0; }).positions) {
    if (p.x > 0.0) points.positions.push_back(p);
  }
  const Partitioned scan(std::move(points));
  const std::vector<Patch> patches = scan.patches(options_for(kStep));
  for (double y = -0.4; y <= 0.4; y += 0.01) {
    for (double x = -0.4; x <= 0.4; x += 0.01) {
      // Where the density jumps, voids are five times as wide as the dense side's spacing.
      if (x > 0.0 && x < 4.0 * kStep) continue;
      bool covered = false;
      for (const Patch& patch : patches) {
        const auto distance = distance_to_patch(patch, {x, y, 0.0});
        covered |= distance && *distance < kStep / 10.0;
      }
      EXPECT_TRUE(covered) << x << ", " << y;
    }
  }
}

TEST(Resample, OverlapsNeighbouringPatches) {
  const Partitioned scan(test::sample_sphere(8000));
  const double spacing = std::sqrt(4.0 * std::numbers::pi / 8000.0);
  const auto total = [&](int overlap) {
    ResampleOptions options = options_for(spacing);
    options.overlap_cells = overlap;
    std::size_t sum = 0;
    for (const Patch& patch : scan.patches(options)) sum += count_samples(patch);
    return sum;
  };
  EXPECT_LT(total(0), total(1));
  EXPECT_LT(total(1), total(2));
}

TEST(Resample, OverlapsWhereABorderIsSteepForBothPatches) {
  // A plane in two regions whose base planes lean by 64 degrees, to both sides of their border.
  Partitioned scan(test::sample_height_field(0.5, kStep, [](double, double) { return 0.0; }));
  constexpr float kLean = 64.0F / 180.0F * std::numbers::pi_v<float>;
  const float up = scan.points.normals[0].z;
  Region left{{}, {std::sin(kLean), 0.0F, up * std::cos(kLean)}};
  Region right{{}, {-std::sin(kLean), 0.0F, up * std::cos(kLean)}};
  for (std::uint32_t i = 0; i < scan.points.size(); ++i) {
    (scan.points.positions[i].x < 0.0 ? left : right).points.push_back(i);
  }
  scan.regions = {left, right};
  ResampleOptions options = options_for(kStep);
  double inward = 0.0;  // how far the left patch reaches over the border
  for (const int overlap : {0, 1}) {
    options.overlap_cells = overlap;
    double furthest = -1.0;
    const Patch patch = scan.patches(options).front();
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) != kHole) furthest = std::max(furthest, position_of(patch, i, j).x);
      }
    }
    inward = furthest - inward;
  }
  // One cell more on its base plane, which on the plane is 1 / cos 64 degrees = 2.3 times as long.
  EXPECT_NEAR(inward, 2.3 * kStep, 0.2 * kStep);
}

TEST(Resample, PutsNoSampleFarFromEveryPoint) {
  // A flat scan with wrong normals, whose tangent planes leave it beyond its border.
  Points flat = test::sample_height_field(0.4, kStep, [](double, double) { return 0.0; });
  flat.normals.assign(flat.size(), glm::normalize(glm::vec3(5.0F, 0.0F, 1.0F)));
  Partitioned scan(flat);
  Region all{{}, {0.0F, 0.0F, 1.0F}};
  for (std::uint32_t i = 0; i < flat.size(); ++i) all.points.push_back(i);
  scan.regions = {all};
  const Patch patch = scan.patches(options_for(kStep)).front();
  const double widest = std::ranges::max(scan.graph.spacing);  // at the border
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const glm::dvec3& p : flat.positions)
        nearest = std::min(nearest, glm::distance(p, position_of(patch, i, j)));
      EXPECT_LE(nearest, 3.0 * widest);
    }
  }
  EXPECT_GT(count_samples(patch), flat.size() * 9 / 10);
}

TEST(Resample, WidensTheStepWhere16BitsDoNotHoldTheHeights) {
  const Partitioned scan(
      test::sample_height_field(0.5, kStep, [](double x, double) { return 0.5 * x; }));
  ResampleOptions options = options_for(kStep);
  options.height_step = 1e-9;
  for (const Patch& patch : scan.patches(options)) {
    for (const std::int32_t h : patch.heights) {
      EXPECT_TRUE(h == kHole || (h >= 0 && h <= kMaxHeightRange));
    }
  }
}

TEST(Resample, DefaultSpacingGivesAboutOneSampleAPoint) {
  const Partitioned scan(test::sample_torus({}, kStep));
  const double spacing = choose_spacing(scan.samples(), scan.graph, scan.regions,
                                        std::vector<double>(scan.regions.size(), 1.0),
                                        static_cast<double>(scan.points.size()));
  ResampleOptions options = options_for(spacing);
  options.overlap_cells = 0;
  std::size_t samples = 0;
  for (const Patch& patch : scan.patches(options)) samples += count_samples(patch);
  const auto points = static_cast<double>(scan.points.size());
  EXPECT_NEAR(static_cast<double>(samples), points, 0.03 * points);
}

TEST(Colours, OfOneColouredScanStayExactlyThat) {
  Points points = test::sample_sphere(3000);
  points.colours.assign(points.size(), glm::u8vec3(17, 130, 251));
  const Partitioned scan(std::move(points));
  ResampleOptions options = options_for(0.065);
  options.colour_scale = 2;
  for (const Patch& patch : scan.patches(options)) {
    EXPECT_EQ(patch.colours.width, (patch.width - 1) * 2 + 1);
    EXPECT_EQ(patch.colours.height, (patch.height - 1) * 2 + 1);
    for (const glm::u8vec3& c : patch.colours.texels) EXPECT_EQ(c, glm::u8vec3(17, 130, 251));
  }
}

TEST(Colours, LieWhereThePointsHaveThem) {
  Points points = test::sample_height_field(0.5, kStep, [](double, double) { return 0.0; });
  for (const glm::dvec3& p : points.positions) {
    points.colours.push_back(p.x < 0.0 ? glm::u8vec3(255, 0, 0) : glm::u8vec3(0, 0, 255));
  }
  const Partitioned scan(std::move(points));
  ResampleOptions options = options_for(kStep);
  options.colour_scale = 2;
  for (const Patch& patch : scan.patches(options)) {
    for (std::uint32_t b = 0; b < patch.colours.height; ++b) {
      for (std::uint32_t a = 0; a < patch.colours.width; ++a) {
        const glm::dvec3 p =
            patch.origin + patch.axes * glm::dvec3(a * patch.spacing / 2, b * patch.spacing / 2, 0);
        // The edge is known to about a spacing from scattered samples.
        if (std::abs(p.x) < 1.5 * kStep || std::abs(p.x) > 0.5 || std::abs(p.y) > 0.5) continue;
        const glm::u8vec3 c = patch.colours.texels[std::size_t{b} * patch.colours.width + a];
        EXPECT_GT(p.x < 0.0 ? c.r : c.b, 250) << p.x << ", " << p.y;
        EXPECT_LT(p.x < 0.0 ? c.b : c.r, 20) << p.x << ", " << p.y;
      }
    }
  }
}

TEST(Normals, OfThePointsAreInterpolated) {
  Points points = test::sample_sphere(8000);
  for (const glm::dvec3& p : points.positions) points.normals.emplace_back(p);
  const Partitioned scan(std::move(points));
  ResampleOptions options = options_for(0.04);
  options.normals = NormalSource::Points;
  // Points are 2 degrees apart. The worst nodes are those of the steep rim, beyond the last point
  // that the margin takes (80 degrees), where one cell spans 10 degrees of the sphere.
  EXPECT_LT(worst_deviation(scan.patches(options), test::Sphere{}).angle_degrees, 3.0);
}

/// The mean angle, in degrees, between the normals of a patch's samples and +Z.
double mean_lean(const Patch& patch) {
  double sum = 0.0;
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const glm::dvec3 n =
          patch.axes * glm::dvec3(unit_from_snorm16(texel_at(patch.normals, i, j)));
      sum += glm::degrees(std::acos(std::min(n.z, 1.0)));
    }
  }
  return sum / (patch.width * patch.height);
}

// A plane whose points' normals lean by the same angle, a few degrees or as beside a crease.
TEST(Normals, OfFitsAreTakenWherePointsAgree) {
  for (const auto& [lean, source, expected] : {std::tuple(5.0, NormalSource::Points, 5.0),
                                               std::tuple(5.0, NormalSource::FitsAndPoints, 0.0),
                                               std::tuple(30.0, NormalSource::Points, 30.0),
                                               std::tuple(30.0, NormalSource::FitsAndPoints, 30.0),
                                               std::tuple(30.0, NormalSource::Fits, 0.0)}) {
    Points points = test::sample_height_field(1.0, 0.05, [](double, double) { return 0.0; });
    const double angle = glm::radians(lean);
    points.normals.assign(points.size(), {std::sin(angle), 0.0, std::cos(angle)});
    const Partitioned scan(std::move(points));
    ResampleOptions options = options_for(0.05);
    options.normals = source;
    for (const Patch& patch : scan.patches(options)) EXPECT_NEAR(mean_lean(patch), expected, 0.1);
  }
}

TEST(Measure, KnowsTheDistanceToABilinearPatch) {
  Patch patch;
  patch.width = 3;
  patch.height = 2;
  patch.spacing = 2.0;
  patch.height_step = 0.5;
  patch.origin = {10, 20, 30};
  patch.heights = {0, 4, kHole, 0, 4, 4};  // rises by 2 per 2 along x: 45 degrees
  const auto distance = [&](double x, double y, double z) {
    return distance_to_patch(patch, patch.origin + glm::dvec3(x, y, z));
  };
  EXPECT_NEAR(*distance(1, 1, 1), 0.0, 1e-12);
  EXPECT_NEAR(*distance(1, 1, 2), std::sqrt(0.5), 1e-12);
  // Three samples span a plane: (2,0,2), (2,2,2), (4,2,2), level.
  EXPECT_NEAR(*distance(3, 1.5, 2.25), 0.25, 1e-12);
  // Beyond the grid: to the nearest sample.
  EXPECT_NEAR(*distance(-1, 0, 0), 1.0, 1e-12);
  EXPECT_FALSE(distance(100, 0, 0));
}

}  // namespace
}  // namespace relief
