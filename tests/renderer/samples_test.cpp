#include "renderer/samples.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "shaders/include/shared.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

glm::vec2 slope_of(const PatchSamples& samples, std::size_t k) {
  const glm::i8vec2 steps(
      glm::u8vec2(samples.records[k].shape >> 16U, samples.records[k].shape >> 24U));
  return samples.slope_step * glm::vec2(steps);
}

std::uint32_t width_class(const SampleRecord& record) {
  return (record.place >> shared::kClassShift) & shared::kClassMask;
}

bool is_border(const SampleRecord& record) {
  return (record.place & shared::kBorderBit) != 0;
}

TEST(Samples, PlaneHasItsSlopeAndTheLeastWidthEverywhere) {
  const PatchModel model = test::height_field(9, [](double x, double y) { return 0.8 * x - y; });
  const PatchSamples samples = make_samples(model.patches[0]);
  ASSERT_EQ(samples.records.size(), 81U);
  for (std::size_t k = 0; k < 81; ++k) {
    // Heights are in steps of 1/1000 cell, slopes in steps of 1/127 of the steepest.
    EXPECT_NEAR(slope_of(samples, k).x, 0.8F, 0.5F / 127.0F + 0.001F);
    EXPECT_NEAR(slope_of(samples, k).y, -1.0F, 0.5F / 127.0F + 0.001F);
    // Rounded slopes part the planes by some thousandths of a cell, within the least margin.
    if (!is_border(samples.records[k])) {
      EXPECT_EQ(width_class(samples.records[k]), 0U);
    }
    const std::size_t i = k % 9;
    const std::size_t j = k / 9;
    EXPECT_EQ(is_border(samples.records[k]), i == 0 || j == 0 || i == 8 || j == 8);
    EXPECT_EQ(samples.records[k].place & shared::kNodeMask, i);
    EXPECT_EQ((samples.records[k].place >> shared::kRowShift) & shared::kNodeMask, j);
  }
}

TEST(Samples, HolesAreLeftOutAndMakeBorders) {
  PatchModel model = test::height_field(7, [](double x, double) { return x; });
  model.patches[0].heights[24] = kHole;
  const PatchSamples samples = make_samples(model.patches[0]);
  ASSERT_EQ(samples.records.size(), 48U);
  for (const SampleRecord& record : samples.records) {
    const std::uint32_t i = record.place & shared::kNodeMask;
    const std::uint32_t j = (record.place >> shared::kRowShift) & shared::kNodeMask;
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

TEST(Samples, SaddleNeedsWiderSplatsThanAPlane) {
  // The planes of four neighbours on z = a x y part by a in the middle between them.
  const PatchModel model = test::height_field(9, [](double x, double y) { return 0.1 * x * y; });
  const PatchSamples samples = make_samples(model.patches[0]);
  EXPECT_GT(width_class(samples.records[40]), 0U);
}

TEST(Samples, SphereHoldsEverySplat) {
  const PatchModel model =
      test::height_field(12, [](double x, double y) { return 2.0 * std::sin(x) * std::cos(y); });
  const PatchSamples samples = make_samples(model.patches[0]);
  for (std::size_t k = 0; k < samples.records.size(); ++k) {
    const SampleRecord& record = samples.records[k];
    const double half = 0.5 + shared::kMargins[width_class(record)];
    const glm::dvec3 centre(record.place & shared::kNodeMask,
                            (record.place >> shared::kRowShift) & shared::kNodeMask,
                            (record.shape & 0xFFFFU) * samples.height_step);
    const glm::dvec2 slope(slope_of(samples, k));
    for (const double x : {-half, half}) {
      for (const double y : {-half, half}) {
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

}  // namespace
}  // namespace relief
