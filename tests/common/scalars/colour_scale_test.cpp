#include "common/scalars/colour_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/image/srgb.h"

namespace relief {
namespace {

Quantiles percents() {
  Quantiles quantiles{};
  for (std::size_t k = 0; k < quantiles.size(); ++k) quantiles[k] = 10.0 * static_cast<double>(k);
  return quantiles;
}

/// CIE lightness of an sRGB colour.
double lightness(glm::u8vec3 colour) {
  const glm::vec3 light = linear_from_srgb8(colour);
  const double y = 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b;
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(ColourMaps, HaveThePublishedEnds) {
  // The first and the last entry as published by each map's authors.
  EXPECT_EQ(colour_at(ColourMap::Viridis, 0), glm::u8vec3(68, 1, 84));
  EXPECT_EQ(colour_at(ColourMap::Viridis, 1), glm::u8vec3(253, 231, 37));
  EXPECT_EQ(colour_at(ColourMap::Inferno, 0), glm::u8vec3(0, 0, 4));
  EXPECT_EQ(colour_at(ColourMap::Inferno, 1), glm::u8vec3(252, 255, 164));
  EXPECT_EQ(colour_at(ColourMap::Cividis, 0), glm::u8vec3(0, 34, 78));
  EXPECT_EQ(colour_at(ColourMap::Turbo, 0), glm::u8vec3(48, 18, 59));
  EXPECT_EQ(colour_at(ColourMap::Batlow, 0), glm::u8vec3(1, 25, 89));
  EXPECT_EQ(colour_at(ColourMap::Grey, 0.5), glm::u8vec3(128));
}

TEST(ColourMaps, GetLighterAllTheWayButForTurbo) {
  for (const Named<ColourMap>& named : kColourMaps) {
    if (named.value == ColourMap::Turbo) continue;
    double before = lightness(colour_at(named.value, 0.0));
    for (int k = 1; k <= 16; ++k) {
      const double now = lightness(colour_at(named.value, k / 16.0));
      EXPECT_GT(now, before) << named.name << " " << k;
      before = now;
    }
  }
}

TEST(ColourMaps, ClampWhatLiesBeyond) {
  EXPECT_EQ(colour_at(ColourMap::Viridis, -5), colour_at(ColourMap::Viridis, 0));
  EXPECT_EQ(colour_at(ColourMap::Viridis, 5), colour_at(ColourMap::Viridis, 1));
  EXPECT_EQ(colour_at(ColourMap::Viridis, std::nan("")), colour_at(ColourMap::Viridis, 0));
}

TEST(LabelColours, AreTwentyAndDiffer) {
  std::set<std::uint32_t> colours;
  for (std::uint32_t label = 0; label < 20; ++label) {
    const glm::u8vec3 c = label_colour(label);
    colours.insert(c.r << 16U | c.g << 8U | c.b);
  }
  EXPECT_EQ(colours.size(), 20U);
  EXPECT_EQ(label_colour(65534), label_colour(65534 % 20));
  EXPECT_EQ(las_class_colour(255), label_colour(255));
}

TEST(ColourScale, IsFromTheMiddleOfTheValuesByDefault) {
  const auto scale = make_colour_scale({"intensity", {}, {}}, false, percents());
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->low, 20.0);
  EXPECT_EQ(scale->high, 980.0);
  EXPECT_EQ(scale->at(20), colour_at(ColourMap::Viridis, 0));
  EXPECT_EQ(scale->at(500), colour_at(ColourMap::Viridis, 0.5));
  EXPECT_EQ(scale->at(2000), colour_at(ColourMap::Viridis, 1));
}

TEST(ColourScale, TakesNumbersAndPercentages) {
  const ColourRange range{{100.0, false}, {90.0, true}};
  const auto scale = make_colour_scale({"a", ColourMap::Grey, range}, false, percents());
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->low, 100.0);
  EXPECT_EQ(scale->high, 900.0);
  const ColourRange empty{{950.0, false}, {90.0, true}};
  const auto none = make_colour_scale({"a", {}, empty}, false, percents());
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("it is 950 to 900"), std::string::npos);
}

TEST(ColourScale, OfOneValueIsTheMiddleOfTheMap) {
  Quantiles same{};
  same.fill(7.0);
  const auto scale = make_colour_scale({"a", {}, {}}, false, same);
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->at(7.0), colour_at(ColourMap::Viridis, 0.5));
}

TEST(ColourScale, OfLabelsIsAPaletteUnlessAMapIsGiven) {
  const auto classes = make_colour_scale({"classification", {}, {}}, true, percents());
  ASSERT_TRUE(classes);
  EXPECT_TRUE(classes->is_label);
  EXPECT_EQ(classes->at(2), las_class_colour(2));
  const auto others = make_colour_scale({"segment", {}, {}}, true, percents());
  EXPECT_EQ(others->at(2), label_colour(2));
  const auto mapped = make_colour_scale({"segment", ColourMap::Plasma, {}}, true, percents());
  EXPECT_FALSE(mapped->is_label);
  EXPECT_TRUE(mapped->has_labels);
}

}  // namespace
}  // namespace relief
