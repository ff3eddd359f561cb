#include "common/legend/legend.h"

#include <gtest/gtest.h>

#include <numeric>

#include "common/image/srgb.h"
#include "common/legend/draw_text.h"

namespace relief {
namespace {

/// An image of one colour; alpha as given.
Image plain(std::uint32_t width, std::uint32_t height, float value, float alpha) {
  Image image{width, height, {}};
  for (const char* name : {"R", "G", "B", "A"}) {
    const float v = std::string_view(name) == "A" ? alpha : value;
    image.channels.push_back(
        {name, ChannelType::Float, std::vector<float>(std::size_t{width} * height, v)});
  }
  return image;
}

ColourScale bar() {
  ColourScale scale;
  scale.name = "intensity";
  scale.low = 175.0;
  scale.high = 2062.0;
  return scale;
}

ColourScale classes(std::uint32_t count) {
  ColourScale scale;
  scale.name = "classification";
  scale.is_label = scale.has_labels = true;
  for (std::uint32_t k = 0; k < count; ++k) scale.labels.push_back(k);
  return scale;
}

float at(const Image& image, const char* name, std::uint32_t x, std::uint32_t y) {
  return image.find(name)->values[std::size_t{y} * image.width + x];
}

/// How many pixels have exactly this colour.
std::size_t count(const Image& image, glm::u8vec3 colour) {
  std::size_t found = 0;
  for (std::size_t k = 0; k < image.channels[0].values.size(); ++k) {
    const glm::vec3 light(image.channels[0].values[k], image.channels[1].values[k],
                          image.channels[2].values[k]);
    if (srgb8_from_linear(light) == colour) ++found;
  }
  return found;
}

bool drawn(const ColourScale& scale, Image& image, std::optional<LegendCorner> corner = {}) {
  return draw_legend(scale, image, corner);
}

TEST(Text, CoversAsMuchAsTheOutlineDoes) {
  // The letter l of DejaVu Sans is a bar of 184 x 1556 units; its area comes back at any position.
  for (const double shift : {0.0, 0.3, 0.71}) {
    Image image = plain(60, 60, 0.0F, 0.0F);
    Painter(image).text("l", 20.0 + shift, 50.0 + shift, 40.0, glm::vec3(1.0F));
    const auto& values = image.channels[0].values;
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    // Rows are sampled at five heights a pixel: a fifth of a row of 3.6 pixels.
    EXPECT_NEAR(sum, 40.0 / 2048 * 184 * (40.0 / 2048 * 1556), 0.8) << shift;
    EXPECT_EQ(image.channels[3].values, values);
  }
  EXPECT_NEAR(text_width("0000"), 4 * 1303.0 / 2048, 1e-9);
  EXPECT_EQ(text_width("\x01"), text_width("?"));
}

TEST(Text, OutsideOfTheImageIsNothing) {
  Image image = plain(20, 20, 0.25F, 1.0F);
  Painter painter(image);
  painter.text("far away", -500.0, -500.0, 12.0, glm::vec3(1.0F));
  painter.text("far away", 5e6, 5e6, 12.0, glm::vec3(1.0F));
  painter.fill(-10.0, -10.0, -1.0, 40.0, glm::vec3(1.0F), 1.0F);
  EXPECT_EQ(image.channels[0].values, std::vector<float>(400, 0.25F));
}

TEST(Legend, IsReadableOnAnyBackground) {
  for (const auto& [value, alpha] : {std::pair{0.0F, 1.0F}, {1.0F, 1.0F}, {0.0F, 0.0F}}) {
    Image image = plain(640, 512, value, alpha);
    ASSERT_TRUE(drawn(bar(), image));
    // Its panel: 16 pixels from the lower right corner, beside any text.
    const float panel = at(image, "R", 620, 495);
    EXPECT_GE((0.9F + 0.05F) / (panel + 0.05F), 4.5F) << "WCAG's contrast for text";
    EXPECT_GT(at(image, "A", 620, 495), 0.89F);
    EXPECT_EQ(at(image, "R", 2, 2), value);
  }
}

TEST(Legend, HasTheColoursOfTheMap) {
  Image image = plain(640, 512, 0.0F, 1.0F);
  ASSERT_TRUE(drawn(bar(), image));
  EXPECT_GT(count(image, colour_at(ColourMap::Viridis, 0.002)), 0U);
  EXPECT_GT(count(image, colour_at(ColourMap::Viridis, 0.998)), 0U);
}

TEST(Legend, ListsLabelsWithTheirColours) {
  Image image = plain(640, 512, 0.0F, 1.0F);
  ASSERT_TRUE(drawn(classes(7), image));
  for (const std::uint32_t label : {0U, 2U, 6U})
    EXPECT_GT(count(image, las_class_colour(label)), 100U) << label;
  EXPECT_EQ(count(image, las_class_colour(9)), 0U);
}

TEST(Legend, OfManyLabelsFitsTheImage) {
  for (const std::uint32_t labels : {1U, 17U, 18U, 19U, 20U, 65535U}) {
    Image image = plain(640, 512, 0.0F, 1.0F);
    EXPECT_TRUE(drawn(classes(labels), image)) << labels;
    EXPECT_EQ(at(image, "R", 600, 20), 0.0F) << "the upper half stays free";
  }
}

TEST(Legend, IsLeftOutOfTinyImages) {
  for (const ColourScale& scale : {bar(), classes(3)}) {
    Image image = plain(64, 48, 0.5F, 1.0F);
    EXPECT_FALSE(drawn(scale, image));
    EXPECT_EQ(image.channels[0].values, std::vector<float>(64 * 48, 0.5F));
  }
}

TEST(Legend, GoesWhereItHidesLeast) {
  for (const LegendCorner free :
       {LegendCorner{false, false}, {false, true}, {true, false}, {true, true}}) {
    // Something in all corners but one.
    Image image = plain(640, 512, 0.25F, 1.0F);
    Painter painter(image);
    painter.fill(80, 80, 560, 432, glm::vec3(0.5F), 1.0F);
    for (const LegendCorner corner :
         {LegendCorner{false, false}, {false, true}, {true, false}, {true, true}}) {
      if (corner.is_left == free.is_left && corner.is_top == free.is_top) continue;
      const double x = corner.is_left ? 20 : 540;
      const double y = corner.is_top ? 20 : 412;
      painter.fill(x, y, x + 80, y + 80, glm::vec3(0.5F), 1.0F);
    }
    std::optional<LegendCorner> corner;
    ASSERT_TRUE(draw_legend(bar(), image, corner));
    ASSERT_TRUE(corner);
    EXPECT_EQ(corner->is_left, free.is_left);
    EXPECT_EQ(corner->is_top, free.is_top);
    // The next frame keeps it.
    Image next = plain(640, 512, 0.25F, 1.0F);
    ASSERT_TRUE(draw_legend(bar(), next, corner));
    EXPECT_NE(at(next, "R", free.is_left ? 18 : 621, free.is_top ? 18 : 493), 0.25F);
  }
}

TEST(Legend, GrowsWithTheImage) {
  Image small = plain(640, 512, 0.0F, 0.0F);
  Image large = plain(2560, 2048, 0.0F, 0.0F);
  ASSERT_TRUE(drawn(bar(), small));
  ASSERT_TRUE(drawn(bar(), large));
  const auto covered = [](const Image& image) {
    const auto& alpha = image.channels[3].values;
    return std::accumulate(alpha.begin(), alpha.end(), 0.0) / static_cast<double>(alpha.size());
  };
  EXPECT_NEAR(covered(large), covered(small), 0.02);
}

}  // namespace
}  // namespace relief
