// What is covered, and where two images differ in it, on drawings of a few pixels.
#include "common/compare/coverage.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/common/compare/images.h"

namespace relief {
namespace {

using test::grey_image;
using test::set_channel;

/// Rows of '#' (covered) and '.'; as alpha.
Image drawn(const std::vector<std::string>& rows) {
  Image image = grey_image(static_cast<std::uint32_t>(rows[0].size()),
                           static_cast<std::uint32_t>(rows.size()));
  set_channel(image, "A", [&](int x, int y) { return rows[y][x] == '#' ? 1.0F : 0.0F; });
  return image;
}

CoverageErrors count(const Image& test, const Image& reference) {
  const auto masks = find_coverage(test, reference);
  EXPECT_TRUE(masks) << masks.error().message;
  if (!masks) return {};
  return count_coverage_errors(*masks, reference.width, reference.height);
}

std::string fault(const Image& test, const Image& reference) {
  const auto masks = find_coverage(test, reference);
  return masks ? std::string() : masks.error().message;
}

TEST(Coverage, HolesLieInsideTheErodedSilhouette) {
  const Image reference = drawn({
      ".......",
      ".#####.",
      ".#####.",
      ".#####.",
      ".#####.",
      ".......",
  });
  const Image test = drawn({
      "#......",  // one extra
      ".####..",  // missing at the rim
      ".#.###.",  // a hole
      ".###..#",  // a hole, missing at the rim, one extra
      ".#####.",
      ".......",
  });
  const CoverageErrors errors = count(test, reference);
  EXPECT_EQ(errors.covered_reference, 20U);
  EXPECT_EQ(errors.covered_both, 16U);
  EXPECT_EQ(errors.holes, 2U);
  EXPECT_EQ(errors.border_missing, 2U);
  EXPECT_EQ(errors.border_extra, 2U);
}

TEST(Coverage, DiagonalNeighboursErodeToo) {
  // The middle has four covered neighbours, but a corner is open.
  const Image reference = drawn({"##.", "###", "###"});
  const CoverageErrors errors = count(drawn({"##.", "#.#", "###"}), reference);
  EXPECT_EQ(errors.holes, 0U);
  EXPECT_EQ(errors.border_missing, 1U);
}

TEST(Coverage, TheRimOfTheImageIsNoSilhouette) {
  const Image reference = drawn({"###.", "###.", "###."});
  const CoverageErrors errors = count(drawn({".##.", "###.", "###."}), reference);
  EXPECT_EQ(errors.holes, 1U);
  EXPECT_EQ(errors.border_missing, 0U);
}

TEST(Coverage, HalfAnAlphaCovers) {
  Image reference = drawn({"#.", ".."});
  Image test = reference;
  set_channel(reference, "A", [](int x, int y) { return x + y == 0 ? 0.5F : 0.49F; });
  EXPECT_EQ(count(test, reference).covered_reference, 1U);
  EXPECT_EQ(count(test, reference).covered_both, 1U);
}

TEST(Coverage, DepthDecidesWithAnOpaqueBackground) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  Image opaque = grey_image(3, 1);
  set_channel(opaque, "A", [](int, int) { return 1.0F; });
  EXPECT_NE(fault(opaque, opaque), "");
  set_channel(opaque, "Z", [](int x, int) { return x == 1 ? 2.0F : kNothing; });
  EXPECT_EQ(count(opaque, opaque).covered_both, 1U);
  // Depth decides for both images, even if one has a transparent background: an antialiased rim has
  // a depth but little alpha.
  Image transparent = opaque;
  set_channel(transparent, "A", [](int x, int) { return x == 1 ? 0.25F : 0.0F; });
  EXPECT_EQ(count(transparent, opaque).covered_both, 1U);
  EXPECT_EQ(count(opaque, transparent).covered_both, 1U);
  EXPECT_EQ(count(transparent, transparent).covered_both, 0U);
  // Without a depth of its own it goes by its alpha.
  transparent.channels.pop_back();
  EXPECT_EQ(count(transparent, opaque).covered_both, 0U);
  EXPECT_EQ(count(transparent, opaque).covered_reference, 1U);
}

TEST(Coverage, IsUnknownWithoutAlphaAndDepth) {
  const Image covered = drawn({"#."});
  EXPECT_NE(fault(grey_image(2, 1), covered).find("the image under test has neither"),
            std::string::npos);
  EXPECT_NE(fault(covered, grey_image(2, 1)).find("the reference has neither"), std::string::npos);
}

TEST(Coverage, AnEmptyImageMissesAll) {
  const Image reference = drawn({".....", ".###.", ".###.", ".###.", "....."});
  const CoverageErrors errors =
      count(drawn({".....", ".....", ".....", ".....", "....."}), reference);
  EXPECT_EQ(errors.holes, 1U);
  EXPECT_EQ(errors.border_missing, 8U);
}

}  // namespace
}  // namespace relief
