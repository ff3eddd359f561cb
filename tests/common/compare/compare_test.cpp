// The numbers of a comparison, each against what was put into the images.
#include "common/compare/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <random>

#include "common/compare/heatmap.h"
#include "common/image/srgb.h"
#include "tests/common/compare/images.h"

namespace relief {
namespace {

using test::grey_image;
using test::must_compare;
using test::set_channel;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image with_normal(Image image, const std::function<glm::vec3(int, int)>& normal) {
  set_channel(image, "N.X", [&](int x, int y) { return normal(x, y).x; });
  set_channel(image, "N.Y", [&](int x, int y) { return normal(x, y).y; });
  set_channel(image, "N.Z", [&](int x, int y) { return normal(x, y).z; });
  return image;
}

glm::vec3 leaning(double degrees) {
  return {std::sin(glm::radians(degrees)), 0.0, std::cos(glm::radians(degrees))};
}

TEST(Compare, PsnrIsOfWhatADisplayShows) {
  const Image reference = grey_image(10, 10, linear_from_srgb(0.5F));
  Image test = grey_image(10, 10, linear_from_srgb(0.6F));
  // 0.1 everywhere is 20 dB; both encodings round to about 1e-7.
  EXPECT_NEAR(must_compare(test, reference).psnr_db, 20.0, 1e-4);
  // In one channel of three, and half of the pixels, the mean square is a sixth.
  test = reference;
  set_channel(test, "G", [](int x, int) { return linear_from_srgb(x < 5 ? 0.6F : 0.5F); });
  EXPECT_NEAR(must_compare(test, reference).psnr_db, 20.0 + 10.0 * std::log10(6.0), 1e-4);
}

TEST(Compare, LightBeyondTheDisplayIsWhite) {
  EXPECT_EQ(must_compare(grey_image(4, 4, 7.0F), grey_image(4, 4, 1.0F)).psnr_db, kInfinity);
  EXPECT_EQ(must_compare(grey_image(4, 4, -1.0F), grey_image(4, 4, 0.0F)).psnr_db, kInfinity);
}

TEST(Compare, CoveredPixelsHaveAPsnrOfTheirOwn) {
  Image reference = grey_image(10, 10, linear_from_srgb(0.5F));
  set_channel(reference, "A", [](int x, int) { return x < 5 ? 1.0F : 0.0F; });
  Image test = reference;
  set_channel(test, "R", [](int x, int) { return linear_from_srgb(x < 4 ? 0.8F : 0.5F); });
  set_channel(test, "A", [](int x, int) { return x < 4 ? 1.0F : 0.0F; });
  const Comparison comparison = must_compare(test, reference);
  ASSERT_TRUE(comparison.psnr_covered_db);
  // All of the 40 pixels that both cover are off by 0.3 in one of three channels.
  EXPECT_NEAR(*comparison.psnr_covered_db, 20.0 * std::log10(std::sqrt(3.0) / 0.3), 1e-4);
  ASSERT_TRUE(comparison.psnr_alpha_db);
  EXPECT_NEAR(*comparison.psnr_alpha_db, 10.0, 1e-9);  // a tenth of the pixels is off by 1
  set_channel(test, "A", [](int, int) { return 0.0F; });
  EXPECT_FALSE(must_compare(test, reference).psnr_covered_db);
}

TEST(Compare, NormalsAreComparedInDegrees) {
  const auto facing = [](int, int) { return leaning(0.0); };
  const Image reference = with_normal(grey_image(20, 10), facing);
  // Three of 200 pixels lean by 60 degrees, the others by 10; lengths do not matter.
  const Image test = with_normal(grey_image(20, 10), [](int x, int y) {
    return y == 0 && x < 3 ? leaning(60.0) : 2.0F * leaning(10.0);
  });
  const auto errors = must_compare(test, reference).normal;
  ASSERT_TRUE(errors) << errors.error().message;
  // Normals are floats: 1e-7 radians is 6e-6 degrees.
  EXPECT_NEAR(errors->rms_deg, std::sqrt((3 * 3600.0 + 197 * 100.0) / 200.0), 1e-4);
  EXPECT_NEAR(errors->p99_deg, 60.0, 1e-4);  // 1.5 % are off by more than 10
  const Image better = with_normal(
      grey_image(20, 10), [](int x, int y) { return leaning(y == 0 && x < 2 ? 60.0 : 10.0); });
  EXPECT_NEAR(must_compare(better, reference).normal->p99_deg, 10.0, 1e-4);  // 1 % is
  // Opposite normals, which an arc cosine makes NaN of now and then.
  const auto away = [](int, int) { return -leaning(0.0); };
  EXPECT_NEAR(must_compare(with_normal(grey_image(20, 10), away), reference).normal->rms_deg, 180.0,
              1e-4);
  const auto same = must_compare(reference, reference).normal;
  EXPECT_EQ(same->rms_deg, 0.0);
  EXPECT_EQ(same->psnr_db, kInfinity);
}

TEST(Compare, NormalPsnrIsOfTheComponents) {
  const auto up = [](int, int) { return glm::vec3(0, 1, 0); };
  const auto down = [](int, int) { return glm::vec3(0, -1, 0); };
  const auto errors =
      must_compare(with_normal(grey_image(2, 2), up), with_normal(grey_image(2, 2), down)).normal;
  EXPECT_NEAR(errors->psnr_db, 10.0 * std::log10(3.0), 1e-9);  // 2 of 2 in one of three components
}

TEST(Compare, NormalsThatAreNoneAreLeftOut) {
  const auto facing = [](int, int) { return leaning(0.0); };
  const Image reference = with_normal(grey_image(4, 1), facing);
  const Image test = with_normal(grey_image(4, 1), [](int x, int) {
    const glm::vec3 normals[] = {leaning(5.0), glm::vec3(0), glm::vec3(kNan, 0, 1),
                                 glm::vec3(kInfinity, 0, 0)};
    return normals[x];
  });
  const Comparison comparison = must_compare(test, reference);
  ASSERT_TRUE(comparison.normal);
  EXPECT_NEAR(comparison.normal->rms_deg, 5.0, 1e-4);
  EXPECT_EQ(comparison.non_finite, 2U);
  EXPECT_EQ(comparison.non_finite_reference, 0U);
  const auto none = [](int, int) { return glm::vec3(0); };
  EXPECT_FALSE(must_compare(with_normal(grey_image(4, 1), none), reference).normal);
}

TEST(Compare, GeometryIsComparedWhereBothCover) {
  Image reference = with_normal(grey_image(4, 1), [](int, int) { return leaning(0.0); });
  set_channel(reference, "Z", [](int x, int) { return x < 3 ? 2.0F : kInfinity; });
  Image test = with_normal(grey_image(4, 1), [](int x, int) { return leaning(x == 0 ? 7 : 50); });
  set_channel(test, "Z", [](int x, int) { return x == 0 ? 3.0F : kInfinity; });
  const Comparison comparison = must_compare(test, reference);
  EXPECT_NEAR(comparison.normal->rms_deg, 7.0, 1e-4);
  EXPECT_DOUBLE_EQ(comparison.depth->rms_relative, 0.5);
}

TEST(Compare, DepthIsRelativeToTheReference) {
  Image reference = grey_image(10, 10);
  set_channel(reference, "Z", [](int x, int y) { return static_cast<float>(1 + x + 10 * y); });
  Image test = grey_image(10, 10);
  // An eighth too far: exact in floats. One in a hundred is twice as far.
  set_channel(test, "Z", [](int x, int y) {
    return static_cast<float>(1 + x + 10 * y) * (x + y == 0 ? 2.0F : 1.125F);
  });
  const auto errors = must_compare(test, reference).depth;
  ASSERT_TRUE(errors) << errors.error().message;
  EXPECT_DOUBLE_EQ(errors->rms_relative, std::sqrt((99 * 0.125 * 0.125 + 1.0) / 100.0));
  EXPECT_DOUBLE_EQ(errors->p99_relative, 0.125);
  // Peak 99: the depths of the reference reach from 1 to 100.
  double squares = 1.0;
  for (int z = 2; z <= 100; ++z) squares += 0.125 * 0.125 * z * z;
  ASSERT_TRUE(errors->psnr_db);
  EXPECT_NEAR(*errors->psnr_db, 20.0 * std::log10(99.0 / std::sqrt(squares / 100.0)), 1e-9);
}

TEST(Compare, DepthsThatAreNoneAreLeftOut) {
  Image reference = grey_image(6, 1);
  Image test = grey_image(6, 1);
  const float depths[] = {2.0F, 0.0F, -1.0F, kNan, kInfinity, 4.0F};
  set_channel(reference, "Z", [&](int x, int) { return depths[x]; });
  set_channel(test, "Z", [](int x, int) { return x == 5 ? kNan : 3.0F; });
  const Comparison comparison = must_compare(test, reference);
  EXPECT_DOUBLE_EQ(comparison.depth->rms_relative, 0.5);
  EXPECT_FALSE(comparison.depth->psnr_db);  // one depth has no range
  EXPECT_EQ(comparison.non_finite, 1U);
  EXPECT_EQ(comparison.non_finite_reference, 1U);  // infinitely far is nothing, not wrong
}

TEST(Compare, GridCoordinatesCountOnTheSamePatch) {
  Image reference = grey_image(4, 1);
  set_channel(reference, "UV.U", [](int x, int) { return static_cast<float>(x); });
  set_channel(reference, "UV.V", [](int x, int) { return static_cast<float>(10 - x); });
  set_channel(reference, "patch", [](int x, int) { return x == 3 ? 0.0F : 5.0F; });
  Image test = reference;
  set_channel(test, "UV.U", [](int x, int) { return static_cast<float>(x) + 0.5F; });
  set_channel(test, "patch", [](int x, int) { return x == 0 ? 4.0F : x == 3 ? 0.0F : 5.0F; });
  const auto psnr = must_compare(test, reference).psnr_uv_db;
  ASSERT_TRUE(psnr) << psnr.error().message;
  // Pixels 1 and 2: U off by 0.5, V by nothing; coordinates reach from 1 to 9.
  EXPECT_NEAR(*psnr, 20.0 * std::log10(8.0 / std::sqrt(0.125)), 1e-9);
  set_channel(test, "patch", [](int, int) { return 9.0F; });
  EXPECT_FALSE(must_compare(test, reference).psnr_uv_db);
}

TEST(Compare, WhatIsMissingIsNamed) {
  Image full = with_normal(grey_image(4, 1), [](int, int) { return leaning(0.0); });
  set_channel(full, "Z", [](int, int) { return 1.0F; });
  const Comparison comparison = must_compare(grey_image(4, 1), full);
  EXPECT_EQ(comparison.normal.error().message, "the image under test has no channel N.X");
  EXPECT_EQ(comparison.depth.error().message, "the image under test has no channel Z");
  EXPECT_EQ(must_compare(full, grey_image(4, 1)).depth.error().message,
            "the reference has no channel Z");
}

TEST(Compare, IdenticalMeansEveryBitOfEveryChannel) {
  Image image = grey_image(4, 4);
  set_channel(image, "Z", [](int x, int) { return x == 0 ? kInfinity : 1.0F; });
  EXPECT_TRUE(must_compare(image, image).identical);
  Image other = image;
  other.channels.back().values[3] = std::nextafter(1.0F, 2.0F);
  EXPECT_FALSE(must_compare(other, image).identical);
  other.channels.pop_back();
  EXPECT_FALSE(must_compare(other, image).identical);
  EXPECT_FALSE(must_compare(image, other).identical);
}

TEST(Compare, SaysWhatCanNotBeCompared) {
  Progress progress;
  const auto message = [&](const Image& test, const Image& reference) {
    const auto comparison = compare_images(test, reference, {}, progress);
    return comparison ? std::string() : comparison.error().message;
  };
  EXPECT_NE(message(grey_image(4, 3), grey_image(4, 4)).find("4x3"), std::string::npos);
  Image depth{2, 2, {}};
  set_channel(depth, "Z", [](int, int) { return 1.0F; });
  EXPECT_EQ(message(depth, grey_image(2, 2)), "the image under test has no channel R");
  EXPECT_EQ(message(grey_image(2, 2), depth), "the reference has no channel R");
}

TEST(Compare, BrokenColourCountsAsWhollyWrong) {
  const Image reference = grey_image(10, 10);
  Image test = reference;
  test.channels[1].values[7] = kNan;
  const Comparison comparison = must_compare(test, reference);
  EXPECT_NEAR(comparison.psnr_db, 20.0, 1e-9);  // one pixel of a hundred is off by 1
  EXPECT_EQ(comparison.non_finite, 1U);
  // It is never equal to anything, not even to itself.
  EXPECT_NEAR(must_compare(test, test).psnr_db, 20.0, 1e-9);
}

/// Every number of a comparison, and whether it is one.
void expect_numbers(const Comparison& c) {
  const auto is_number = [](double value) { return !std::isnan(value); };
  EXPECT_TRUE(is_number(c.psnr_db) && std::isfinite(c.flip.mean));
  EXPECT_TRUE(!c.psnr_covered_db || is_number(*c.psnr_covered_db));
  EXPECT_TRUE(!c.psnr_uv_db || is_number(*c.psnr_uv_db));
  EXPECT_TRUE(!c.psnr_alpha_db || is_number(*c.psnr_alpha_db));
  EXPECT_TRUE(!c.normal || (std::isfinite(c.normal->rms_deg) && std::isfinite(c.normal->p99_deg) &&
                            is_number(c.normal->psnr_db)));
  EXPECT_TRUE(!c.depth ||
              (std::isfinite(c.depth->rms_relative) && std::isfinite(c.depth->p99_relative)));
  EXPECT_TRUE(!c.depth || !c.depth->psnr_db || is_number(*c.depth->psnr_db));
  for (const float value : c.flip.map) EXPECT_TRUE(value >= 0.0F && value <= 1.0F);
}

TEST(Compare, NoNumberIsNanWhateverTheImagesHold) {
  const float values[] = {kNan,    kInfinity, -kInfinity, 0.0F,  -0.0F, 1.0F,
                          3.4e38F, -3.4e38F,  1e-45F,     -1.0F, 0.5F,  1e-38F};
  std::mt19937 random(1);
  const auto any = [&](int, int) { return values[random() % std::size(values)]; };
  Progress progress;
  for (int i = 0; i < 20; ++i) {
    Image images[2] = {{7, 5, {}}, {7, 5, {}}};
    for (Image& image : images) {
      for (const char* name :
           {"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "Z", "UV.U", "UV.V", "patch"}) {
        set_channel(image, name, any);
      }
    }
    for (const FlipRange range : {FlipRange::Ldr, FlipRange::Hdr}) {
      const auto comparison = compare_images(images[0], images[1], {range}, progress);
      ASSERT_TRUE(comparison);
      expect_numbers(*comparison);
    }
  }
}

TEST(Heatmap, HasThePublishedColours) {
  const Image image = make_heatmap({0.0F, 0.5F, 1.0F, 0.25F}, 2, 2);
  const auto colour = [&](std::size_t k) {
    int rgb = 0;
    for (const Channel& channel : image.channels) {
      rgb = rgb * 256 + srgb8_from_linear(channel.values[k]);
    }
    return rgb;
  };
  // Entries 0, 128, 255 and 64 of magma, as matplotlib prints them.
  EXPECT_EQ(colour(0), 0x000004);
  EXPECT_EQ(colour(1), 0xB73779);
  EXPECT_EQ(colour(2), 0xFCFDBF);
  EXPECT_EQ(colour(3), 0x51127C);
}

}  // namespace
}  // namespace relief
