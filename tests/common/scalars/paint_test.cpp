#include "common/scalars/paint.h"

#include <gtest/gtest.h>

#include "common/patch_file/fast/patch_codec.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

PatchModel painted_model() {
  PatchModel model = test::bumpy_model(3, 1);
  test::add_scalars(model);
  return model;
}

TEST(PaintScalar, GivesEachTexelTheColourOfItsValue) {
  const PatchModel before = painted_model();
  PatchModel model = before;
  ColourScale scale =
      *make_colour_scale({"intensity", {}, {}}, false, quantiles_of(model.scalars[0]));
  paint_scalar(0, scale, model);
  EXPECT_TRUE(model.has_colours);
  EXPECT_FALSE(model.has_label_colours);
  EXPECT_TRUE(model.scalars.empty());
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    const Patch& patch = model.patches[p];
    const AttributeMap<std::uint16_t>& codes = before.patches[p].scalars[0];
    EXPECT_TRUE(patch.scalars.empty());
    ASSERT_EQ(patch.colours.texels.size(), codes.texels.size());
    const std::vector<std::uint8_t> kept = kept_texels(patch, codes.scale);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      if (kept[k] == 0) continue;
      const glm::u8vec3 expected = codes.texels[k] == kNoScalar
                                       ? kNoScalarColour
                                       : scale.at(before.scalars[0].value_of(codes.texels[k]));
      ASSERT_EQ(patch.colours.texels[k], expected);
    }
  }
}

TEST(PaintScalar, ListsTheLabelsThatOccur) {
  PatchModel model = painted_model();
  ColourScale scale =
      *make_colour_scale({"classification", {}, {}}, true, quantiles_of(model.scalars[1]));
  paint_scalar(1, scale, model);
  EXPECT_EQ(scale.labels, (std::vector<std::uint32_t>{2, 3, 4}));
  EXPECT_TRUE(model.has_label_colours);
  for (const Patch& patch : model.patches) {
    for (const glm::u8vec3 colour : patch.colours.texels) {
      const bool is_one = colour == las_class_colour(2) || colour == las_class_colour(3) ||
                          colour == las_class_colour(4);
      ASSERT_TRUE(is_one) << "also over holes";
    }
  }
}

TEST(PaintScalar, PatchesWithoutItHaveNoColours) {
  PatchModel model = painted_model();
  model.patches[1].scalars = {};
  ColourScale scale =
      *make_colour_scale({"intensity", {}, {}}, false, quantiles_of(model.scalars[0]));
  paint_scalar(0, scale, model);
  EXPECT_TRUE(model.patches[1].colours.empty());
  EXPECT_FALSE(model.patches[2].colours.empty());
}

TEST(PaintHeights, FollowsTheUpDirectionAtAnyPlace) {
  for (const glm::dvec3 up : {glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)}) {
    PatchModel model = test::bumpy_model(3);
    const Quantiles heights = height_quantiles(model, up);
    ColourScale scale =
        *make_colour_scale({"height", {}, ColourRange{{0, true}, {100, true}}}, false, heights);
    paint_heights(scale, up, model);
    double lowest = 1e300;
    glm::u8vec3 colour(0);
    for (const Patch& patch : model.patches) {
      for (std::uint32_t j = 0; j < patch.height; ++j) {
        for (std::uint32_t i = 0; i < patch.width; ++i) {
          if (patch.at(i, j) == kHole) continue;
          const double height = glm::dot(position_of(patch, i, j), up);
          if (height >= lowest) continue;
          lowest = height;
          colour = patch.colours.texels[std::size_t{j} * patch.width + i];
        }
      }
    }
    EXPECT_EQ(scale.low, lowest);
    EXPECT_EQ(colour, colour_at(ColourMap::Viridis, 0));
  }
}

TEST(PaintHeights, OfNothingIsNothing) {
  PatchModel model;
  EXPECT_EQ(height_quantiles(model, {0, 0, 1}), Quantiles{});
  paint_heights({}, {0, 0, 1}, model);
  EXPECT_TRUE(model.patches.empty());
}

}  // namespace
}  // namespace relief
