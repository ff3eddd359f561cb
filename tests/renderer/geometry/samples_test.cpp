#include "renderer/geometry/samples/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "shaders/include/shared.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

glm::vec2 slope_of(const PatchSamples& samples, std::size_t k) {
  const glm::i8vec2 steps(
      glm::u8vec2(samples.records[k].shape >> 16U, samples.records[k].shape >> 24U));
  return samples.slope_step * glm::vec2(steps);
}

glm::vec4 lengths_of(std::uint32_t bytes, float step) {
  glm::vec4 lengths(0.0F);
  for (glm::length_t c = 0; c < 4; ++c)
    lengths[c] = step * static_cast<float>((bytes >> (8 * c)) & 0xFFU);
  return lengths;
}

/// How far a splat extends toward -x, +x, -y, +y, in cells.
glm::vec4 reach_of(const SampleRecord& record) {
  return lengths_of(record.reach, shared::kReachStep);
}

/// By how much its plane and the next ones part there, in cells.
glm::vec4 gap_of(const SampleRecord& record) {
  return lengths_of(record.gap, shared::kGapStep);
}

/// What rounding may add to a reach: it is rounded up to steps, and slopes and heights are rounded,
/// which moves meetings of equal planes by their margin at most.
constexpr float kRounding = shared::kReachStep + 0.01F;

bool is_border(const SampleRecord& record) {
  return (record.node & shared::kBorderBit) != 0;
}

TEST(Samples, SplatsOfAPlaneMeetHalfWay) {
  const PatchModel model = test::height_field(9, [](double x, double y) { return 0.8 * x - y; });
  const PatchSamples samples = make_samples(model.patches[0]);
  ASSERT_EQ(samples.records.size(), 81U);
  for (std::size_t k = 0; k < 81; ++k) {
    // Heights are in steps of 1/1000 cell, slopes in steps of 1/127 of the steepest.
    EXPECT_NEAR(slope_of(samples, k).x, 0.8F, 0.5F / 127.0F + 0.001F);
    EXPECT_NEAR(slope_of(samples, k).y, -1.0F, 0.5F / 127.0F + 0.001F);
    if (!is_border(samples.records[k])) {
      for (glm::length_t c = 0; c < 4; ++c) {
        EXPECT_GE(reach_of(samples.records[k])[c], 0.5F);
        EXPECT_LE(reach_of(samples.records[k])[c], 0.5F + shared::kMinMargin + kRounding);
      }
    }
    const std::size_t i = k % 9;
    const std::size_t j = k / 9;
    EXPECT_EQ(is_border(samples.records[k]), i == 0 || j == 0 || i == 8 || j == 8);
    EXPECT_EQ(samples.records[k].node & shared::kNodeMask, i);
    EXPECT_EQ((samples.records[k].node >> shared::kRowShift) & shared::kNodeMask, j);
  }
}

TEST(Samples, HolesAreLeftOutAndMakeBorders) {
  PatchModel model = test::height_field(7, [](double x, double) { return x; });
  model.patches[0].heights[24] = kHole;
  const PatchSamples samples = make_samples(model.patches[0]);
  ASSERT_EQ(samples.records.size(), 48U);
  for (const SampleRecord& record : samples.records) {
    const std::uint32_t i = record.node & shared::kNodeMask;
    const std::uint32_t j = (record.node >> shared::kRowShift) & shared::kNodeMask;
    const bool beside = i >= 2 && i <= 4 && j >= 2 && j <= 4;
    EXPECT_EQ(is_border(record), beside || i == 0 || j == 0 || i == 6 || j == 6);
  }
}

TEST(Samples, TipOfARaggedBorderLeansLikeItsNeighbours) {
  PatchModel model = test::height_field(7, [](double x, double y) { return x + 0.5 * y; });
  for (std::size_t i = 0; i < 7; ++i) {
    if (i != 3) model.patches[0].heights[42 + i] = kHole;
  }
  const PatchSamples samples = make_samples(model.patches[0]);
  const std::size_t tip = samples.records.size() - 1;
  EXPECT_NEAR(slope_of(samples, tip).x, 1.0F, 0.01F);  // as above
  EXPECT_NEAR(slope_of(samples, tip).y, 0.5F, 0.01F);
}

TEST(Samples, GapsAreWhatPlanesPartBy) {
  // In the middle of a cell of z = a x y the planes of two of its corners are a / 2 above the other
  // two.
  const PatchModel model = test::height_field(9, [](double x, double y) { return 0.2 * x * y; });
  const PatchSamples samples = make_samples(model.patches[0]);
  const glm::vec4 gap = gap_of(samples.records[40]);
  for (glm::length_t c = 0; c < 4; ++c) {
    // Slopes are rounded to 0.8 / 127 / 2, half a cell away, along two axes, up and down.
    EXPECT_NEAR(gap[c], 0.1F, shared::kGapStep + 0.0064F);
  }
}

TEST(Samples, PlanesAndBordersHaveNoGaps) {
  const PatchModel plane = test::height_field(9, [](double x, double y) { return 0.8 * x - y; });
  for (const SampleRecord& record : make_samples(plane.patches[0]).records)
    EXPECT_EQ(record.gap, 0U);
  const PatchModel saddle = test::height_field(9, [](double x, double y) { return 0.2 * x * y; });
  for (const SampleRecord& record : make_samples(saddle.patches[0]).records)
    EXPECT_EQ(record.gap == 0U, is_border(record));
}

TEST(Samples, SplatsEndAtACrease) {
  // Flat up to x = 0 (column 4), then down by 3 a cell. At the crease itself the central difference
  // leans by 1.5, which half a cell to the flat side would be a spike of 0.75 cells.
  const PatchModel model =
      test::height_field(9, [](double x, double) { return -3.0 * std::max(x, 0.0); });
  const PatchSamples samples = make_samples(model.patches[0]);
  const std::size_t row = std::size_t{4} * 9;
  const auto at = [&](std::size_t column) { return reach_of(samples.records[row + column]); };
  EXPECT_NEAR(slope_of(samples, row + 4).x, -1.5F, 0.02F);
  // Planes may part by 0.1 where they meet, which the crease's plane does after 0.1 / 1.5 of a
  // cell; the rest is the margin that closes those 0.1 for a view from 30 degrees, 0.1 cos / (2 tan
  // 30), and rounding.
  const float meeting = 0.1F / 1.5F;
  const auto end = [](float position, float slope) {
    return position + 0.1F / std::sqrt(1.0F + slope * slope) / 1.16F + shared::kMinMargin +
           kRounding;
  };
  EXPECT_LE(at(4).x, end(meeting, 1.5F));
  EXPECT_LE(at(4).y, end(meeting, 1.5F));
  // Its neighbours close what it leaves open.
  EXPECT_GE(at(3).y, 1.0F - meeting);
  EXPECT_GE(at(5).x, 1.0F - meeting);
}

TEST(Samples, SplatsEndHalfASpacingBeyondTheBorder) {
  const PatchModel model = test::height_field(9, [](double x, double) { return 2.0 * x; });
  const PatchSamples samples = make_samples(model.patches[0]);
  const glm::vec4 reach = reach_of(samples.records[std::size_t{4} * 9]);
  EXPECT_NEAR(reach.x * std::sqrt(5.0F), 0.5F, (shared::kMinMargin + kRounding) * std::sqrt(5.0F));
}

TEST(Samples, SphereHoldsEverySplat) {
  const PatchModel model =
      test::height_field(12, [](double x, double y) { return 2.0 * std::sin(x) * std::cos(y); });
  const PatchSamples samples = make_samples(model.patches[0]);
  for (std::size_t k = 0; k < samples.records.size(); ++k) {
    const SampleRecord& record = samples.records[k];
    const glm::dvec3 centre(record.node & shared::kNodeMask,
                            (record.node >> shared::kRowShift) & shared::kNodeMask,
                            (record.shape & 0xFFFFU) * samples.height_step);
    const glm::dvec2 slope(slope_of(samples, k));
    // The margins of a view that is as low as any has margins for.
    const double largest = shared::kLargestMargin / std::sqrt(1.0 + glm::dot(slope, slope));
    const glm::dvec4 margin =
        glm::min(0.5 * glm::dvec4(gap_of(record)) / double{shared::kLowestView}, largest);
    const glm::dvec4 reach = glm::dvec4(reach_of(record)) + margin;
    for (const double x : {-reach.x, reach.y}) {
      for (const double y : {-reach.z, reach.w}) {
        const glm::dvec3 corner = centre + glm::dvec3(x, y, x * slope.x + y * slope.y);
        EXPECT_LE(glm::distance(corner, samples.centre), samples.radius);
        EXPECT_LE(glm::distance(corner, centre), samples.widest_disc + 1e-9);
      }
    }
  }
}

TEST(Samples, PatchOfHolesHasNone) {
  PatchModel model = test::height_field(3, [](double, double) { return 0.0; });
  model.patches[0].heights.assign(9, kHole);
  EXPECT_TRUE(make_samples(model.patches[0]).records.empty());
}

TEST(Samples, ReachTowardHolesAsFarAsTheyAreAsked) {
  const PatchModel flat = test::height_field(5, [](double, double) { return 0.0; });
  for (const float to_hole : {kReachToHole, kReachToSeam}) {
    const PatchSamples samples = make_samples(flat.patches[0], to_hole);
    const glm::vec4 corner = reach_of(samples.records.front());  // holes toward -x and -y
    // A margin for rounding comes to each, and a step by which it is rounded up.
    EXPECT_NEAR(corner.x, to_hole, shared::kMinMargin + shared::kReachStep);
    EXPECT_NEAR(corner.y, 0.5F, shared::kMinMargin + shared::kReachStep);
    EXPECT_NEAR(corner.z, to_hole, shared::kMinMargin + shared::kReachStep);
  }
}

TEST(Samples, BoundsAloneAreThoseOfTheSamples) {
  const PatchModel model = test::height_field(9, [](double x, double y) { return x * y; });
  const PatchSamples all = make_samples(model.patches[0]);
  const PatchSamples bounds = bound_samples(model.patches[0]);
  EXPECT_TRUE(bounds.records.empty());
  EXPECT_EQ(bounds.height_step, all.height_step);
  EXPECT_EQ(bounds.centre, all.centre);
  EXPECT_EQ(bounds.radius + all.widest_disc, all.radius);
}

}  // namespace
}  // namespace relief
