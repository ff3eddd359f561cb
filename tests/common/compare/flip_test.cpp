// FLIP against colours whose difference is known, against what the published tool says, and for
// what must not matter.
#include "common/compare/flip.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/compare/flip_filters.h"
#include "common/compare/tone_mapping.h"
#include "common/image/srgb.h"
#include "tests/common/compare/images.h"

namespace relief {
namespace {

using test::image_of;
using test::must_flip;

constexpr float kFlipInfinity = std::numeric_limits<float>::infinity();

Image plain(float r, float g, float b) {
  return image_of(5, 4, [=](int, int) { return glm::vec3(r, g, b); });
}

TEST(Flip, OfEqualImagesIsZero) {
  const Image image = image_of(40, 30, [](int x, int y) {
    return glm::vec3(0.02F * static_cast<float>(x), 0.5F, 0.03F * static_cast<float>(y));
  });
  for (const FlipRange range : {FlipRange::Ldr, FlipRange::Hdr}) {
    const Flip flip = must_flip(image, image, range);
    EXPECT_EQ(flip.mean, 0.0);
    EXPECT_EQ(*std::max_element(flip.map.begin(), flip.map.end()), 0.0F);
  }
}

TEST(Flip, OfPlainColoursIsTheColourDifference) {
  // Filters do not change plain colours. Green against blue is the largest difference there is.
  EXPECT_NEAR(must_flip(plain(0, 1, 0), plain(0, 0, 1), FlipRange::Ldr).mean, 1.0, 1e-5);
  // Black against white differs by 100, only in L*; CIELAB of green (87.737, -86.185, 83.181) and
  // blue (32.302, 79.197, -107.864) is in every table.
  const double largest =
      std::abs(87.737 - 32.302) +
      std::hypot(0.87737 * -86.185 - 0.32302 * 79.197, 0.87737 * 83.181 - 0.32302 * -107.864);
  const double share = std::pow(100.0 / largest, 0.7);
  ASSERT_GT(share, 0.4);
  // Tables round to 0.001, 1e-5 of the largest distance.
  EXPECT_NEAR(must_flip(plain(0, 0, 0), plain(1, 1, 1), FlipRange::Ldr).mean,
              0.95 + (share - 0.4) / 0.6 * 0.05, 1e-5);
  // Greys of L* 50 and 60: a share below 0.4 is stretched by 0.95 / 0.4. The edge
  // filter's weights add up to about 1e-8, the root of which is a feature difference of 1e-4; that
  // raises a value v by up to -v ln(v) 1e-4 (in the published tool too).
  const auto grey = [](float lightness) { return std::pow((lightness + 16.0F) / 116.0F, 3.0F); };
  const double small = std::pow(10.0 / largest, 0.7);
  EXPECT_NEAR(must_flip(plain(grey(50), grey(50), grey(50)), plain(grey(60), grey(60), grey(60)),
                        FlipRange::Ldr)
                  .mean,
              small * 0.95 / 0.4, 1e-4);
}

/// A disc on a ramp; the disc's place and colour differ between the images. 8-bit sRGB values.
glm::vec3 disc(int x, int y, int shift, const glm::vec3& colour) {
  const bool inside = (x - 20 - shift) * (x - 20 - shift) + (y - 14) * (y - 14) < 100;
  return inside ? colour : glm::vec3(30 + 2 * x, 40 + 3 * y, 90);
}

Image disc_image(int shift, const glm::vec3& colour) {
  return image_of(40, 28, [&](int x, int y) {
    const glm::vec3 c = disc(x, y, shift, colour) / 255.0F;
    return glm::vec3(linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z));
  });
}

/// Light of a wide range, in numbers that a float holds exactly; with sparks.
Image disc_light(int shift, const glm::vec3& colour) {
  return image_of(40, 28, [&](int x, int y) {
    const glm::vec3 c = disc(x, y, shift, colour);
    const bool spark = c == colour && (x + y) % 7 == 0;
    return c * c * ((spark ? 16.0F : 1.0F) / 1024.0F);
  });
}

const glm::vec3 kTestDisc(205, 118, 44);
const glm::vec3 kReferenceDisc(200, 120, 40);

/// What the published tool says of these images (flip-evaluator 1.7 of PyPI, asked by
/// flip_published.py in this folder): the mean of its map and six of the map's pixels.
struct Published {
  double mean;
  float pixels[6];
};

void expect_published(const Flip& flip, const Published& published) {
  // Both compute in single precision. On images of 1.3 million pixels means differed by 3e-8,
  // pixels by up to 1.5e-4: a root magnifies the rounding of all but equal features.
  EXPECT_NEAR(flip.mean, published.mean, 1e-6);
  const std::size_t positions[6][2] = {{0, 0}, {9, 14}, {10, 14}, {20, 14}, {31, 14}, {39, 27}};
  for (int i = 0; i < 6; ++i) {
    const std::size_t at = positions[i][1] * 40 + positions[i][0];
    EXPECT_NEAR(flip.map[at], published.pixels[i], 2e-4) << i;
  }
}

TEST(Flip, LdrIsAsPublished) {
  const Image test = disc_image(1, kTestDisc);
  const Image reference = disc_image(0, kReferenceDisc);
  expect_published(
      must_flip(test, reference, FlipRange::Ldr),
      {0.10520649, {0.000000F, 0.269911F, 0.422860F, 0.114799F, 0.387844F, 0.000103F}});
  expect_published(
      must_flip(test, reference, FlipRange::Ldr, 20.0),
      {0.08860109, {0.000000F, 0.082620F, 0.383955F, 0.103516F, 0.375830F, 0.000000F}});
}

TEST(Flip, HdrIsAsPublished) {
  const Flip flip =
      must_flip(disc_light(1, kTestDisc), disc_light(0, kReferenceDisc), FlipRange::Hdr);
  // The tool computes exposures in single precision.
  EXPECT_NEAR(flip.exposures.start, -7.124205112, 1e-6);
  EXPECT_NEAR(flip.exposures.stop, -2.046141624, 1e-6);
  EXPECT_EQ(flip.exposures.count, 6);
  expect_published(
      flip, {0.14744953, {0.000000F, 0.374940F, 0.493215F, 0.193942F, 0.402063F, 0.000146F}});
}

TEST(Flip, TreatsRowsAndColumnsAlike) {
  const auto transposed = [](const Image& image) {
    Image out{image.height, image.width, {}};
    for (const Channel& channel : image.channels) {
      test::set_channel(out, channel.name, [&](int x, int y) {
        return channel
            .values[static_cast<std::size_t>(x) * image.width + static_cast<std::size_t>(y)];
      });
    }
    return out;
  };
  const Image test = disc_image(1, kTestDisc);
  const Image reference = disc_image(0, kReferenceDisc);
  const Flip flip = must_flip(test, reference, FlipRange::Ldr);
  const Flip turned = must_flip(transposed(test), transposed(reference), FlipRange::Ldr);
  for (std::size_t y = 0; y < 28; ++y) {
    for (std::size_t x = 0; x < 40; ++x) {
      // Sums are taken in another order; see expect_published.
      ASSERT_NEAR(flip.map[y * 40 + x], turned.map[x * 28 + y], 2e-4) << x << " " << y;
    }
  }
}

/// A disc at a height of a tall image.
Image tall_image(int middle, float light) {
  return image_of(30, 200, [=](int x, int y) {
    const bool inside = (x - 15) * (x - 15) + (y - middle) * (y - middle) < 50;
    return glm::vec3(inside ? light : 0.2F, 0.3F, 0.1F);
  });
}

TEST(Flip, DoesNotDependOnBandsAndThreads) {
  const Flip upper = must_flip(tall_image(60, 0.8F), tall_image(60, 0.7F), FlipRange::Ldr);
  EXPECT_GT(upper.mean, 0.001);
  // The disc at positions that bands of rows cut differently.
  for (const int shift : {1, 31, 64, 90}) {
    const Flip lower =
        must_flip(tall_image(60 + shift, 0.8F), tall_image(60 + shift, 0.7F), FlipRange::Ldr);
    for (std::size_t k = 0; k < std::size_t{100} * 30; ++k) {
      ASSERT_EQ(upper.map[k], lower.map[k + static_cast<std::size_t>(shift) * 30]) << shift;
    }
  }
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Flip flip = must_flip(tall_image(60, 0.8F), tall_image(60, 0.7F), FlipRange::Ldr);
    EXPECT_EQ(flip.map, upper.map);
    EXPECT_EQ(flip.mean, upper.mean);
  }
}

TEST(Flip, TreatsBothEndsAlike) {
  const auto reversed = [](Image image) {
    for (Channel& channel : image.channels) {
      std::reverse(channel.values.begin(), channel.values.end());
    }
    return image;
  };
  // The disc is cut by the lower rim, where the rows repeat for the filters.
  const Image test = tall_image(197, 0.8F);
  const Image reference = tall_image(195, 0.7F);
  const Flip flip = must_flip(test, reference, FlipRange::Ldr);
  const Flip turned = must_flip(reversed(test), reversed(reference), FlipRange::Ldr);
  EXPECT_GT(flip.mean, 0.001);
  for (std::size_t k = 0; k < flip.map.size(); ++k) {
    // Sums are taken in another order; see expect_published.
    ASSERT_NEAR(flip.map[k], turned.map[flip.map.size() - 1 - k], 2e-4) << k;
  }
}

TEST(Flip, ExposuresReachFromTheBrightestToTheMedian) {
  const double light = light_shown_as(0.85);
  EXPECT_NEAR(tone_map(static_cast<float>(light), 1.0), 0.85F, 1e-6F);
  EXPECT_EQ(tone_map(3e38F, 1e30), 1.0F);  // and not infinity over infinity
  const auto exposures_of = [](const std::function<float(int, int)>& value) {
    return find_exposures(
        *take_colour(image_of(8, 8, [&](int x, int y) { return glm::vec3(value(x, y)); })));
  };
  // A luminance of 1 is one but for rounding: its weights add up to 1.
  const Exposures plain_light = exposures_of([](int, int) { return 1.0F; });
  EXPECT_EQ(plain_light.count, 1);
  EXPECT_NEAR(plain_light.start, std::log2(light), 1e-6);
  // 32 times the median: five stops.
  const Exposures spark = exposures_of([](int x, int y) { return x + y == 0 ? 31.0F : 1.0F; });
  EXPECT_EQ(spark.count, 5);
  EXPECT_NEAR(spark.start, std::log2(light / 31.0), 1e-6);
  EXPECT_NEAR(spark.stop, std::log2(light), 1e-6);
  // Less than two stops are two exposures.
  EXPECT_EQ(exposures_of([](int x, int) { return x == 0 ? 1.5F : 1.0F; }).count, 2);
  // The majority is black: the floor of the median, 2^-23.
  const Exposures on_black = exposures_of([](int x, int) { return x < 3 ? 0.5F : 0.0F; });
  EXPECT_NEAR(on_black.stop, std::log2(light) + 23.0, 1e-6);
  EXPECT_EQ(on_black.count, 22);
  const Exposures black = exposures_of([](int, int) { return 0.0F; });
  EXPECT_EQ(black.count, 1);
  EXPECT_NEAR(black.stop, std::log2(light) + 23.0, 1e-6);
}

TEST(Flip, LightAgainstBlackIsSeen) {
  EXPECT_GT(must_flip(plain(0.5F, 0.5F, 0.5F), plain(0, 0, 0), FlipRange::Hdr).mean, 0.9);
}

TEST(Flip, BrokenPixelsAreWrongAndDoNotSpread) {
  Image reference = disc_light(0, kReferenceDisc);
  Image test = reference;
  const float broken[] = {std::numeric_limits<float>::quiet_NaN(), kFlipInfinity, -kFlipInfinity};
  for (std::size_t i = 0; i < 3; ++i) test.channels[i].values[500 + i] = broken[i];
  reference.channels[0].values[600] = broken[0];
  test.channels[0].values[600] = broken[0];
  for (const FlipRange range : {FlipRange::Ldr, FlipRange::Hdr}) {
    const Flip flip = must_flip(test, reference, range);
    for (const std::size_t k : {500, 501, 502, 600}) EXPECT_EQ(flip.map[k], 1.0F);
    for (const float value : flip.map) EXPECT_TRUE(value >= 0.0F && value <= 1.0F) << value;
    EXPECT_EQ(flip.map[0], 0.0F);
  }
}

TEST(Flip, HugeTinyAndNegativeLightStaysWithinBounds) {
  const float values[] = {3e38F, 1e-45F, -3e38F, 0.0F, 1.0F, 65504.0F, -0.0F};
  const Image test = image_of(20, 20, [&](int x, int y) {
    return glm::vec3(values[(x + y) % 7], values[(x * y) % 7], values[x % 7]);
  });
  const Image reference = image_of(20, 20, [&](int x, int y) {
    return glm::vec3(values[(x + 2 * y) % 7], values[y % 7], values[(x + 1) % 7]);
  });
  for (const FlipRange range : {FlipRange::Ldr, FlipRange::Hdr}) {
    for (const double pixels_per_degree : {1.0, 67.0}) {
      const Flip flip = must_flip(test, reference, range, pixels_per_degree);
      for (const float value : flip.map) ASSERT_TRUE(value >= 0.0F && value <= 1.0F) << value;
      EXPECT_GT(flip.mean, 0.0);
    }
  }
}

TEST(Flip, FiltersKeepWhatTheyMust) {
  const auto sum = [](const Taps& taps) {
    double total = 0.0;
    for (const float tap : taps) total += tap;
    return total;
  };
  for (const double pixels_per_degree : {1.0, 20.0, kFlipPixelsPerDegree, 1000.0}) {
    const FlipFilters f = make_flip_filters(pixels_per_degree);
    EXPECT_EQ(f.luminance.size(), 2 * f.contrast_radius + 1);
    EXPECT_EQ(f.smooth.size(), 2 * f.feature_radius + 1);
    // Sums of up to 271 rounded floats.
    EXPECT_NEAR(sum(f.luminance), 1.0, 1e-6);
    EXPECT_NEAR(sum(f.red_green), 1.0, 1e-6);
    EXPECT_NEAR(std::pow(sum(f.blue_yellow), 2) + std::pow(sum(f.blue_yellow_wide), 2), 1.0, 1e-6);
    EXPECT_NEAR(sum(f.smooth), 1.0, 1e-6);
    EXPECT_NEAR(sum(f.edge), 0.0, 1e-6);
    EXPECT_NEAR(sum(f.point), 0.0, 1e-6);
    // A step of height 1 has an edge of height 1 where it is steepest.
    double above = 0.0;
    for (const float tap : f.edge) above += std::max(tap, 0.0F);
    EXPECT_NEAR(above, 1.0, 1e-6);
  }
  // 2020, section 4.1.1: at 67 pixels per degree the filters reach 10 and 9 pixels.
  EXPECT_EQ(make_flip_filters(kFlipPixelsPerDegree).contrast_radius, 10U);
  EXPECT_EQ(make_flip_filters(kFlipPixelsPerDegree).feature_radius, 9U);
}

TEST(Flip, CanBeCancelled) {
  struct Cancelled : Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } progress;
  const auto colour = take_colour(plain(1, 1, 1));
  EXPECT_FALSE(measure_flip(*colour, *colour, {}, progress));
}

}  // namespace
}  // namespace relief
