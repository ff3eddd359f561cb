// What a value of a volume looks like: functions, presets, histograms and files.
#include "common/volume/transfer_function.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

constexpr double kNoGradient = 0.0;

/// Values along a line of nodes, `spacing` apart.
ScalarVolume line_of(std::vector<float> values, double spacing = 1.0) {
  ScalarVolume volume;
  volume.size = {static_cast<std::uint32_t>(values.size()), 1, 1};
  volume.placement = RegularGrid{glm::dvec3(0.0), glm::dmat3(spacing)};
  volume.values = std::move(values);
  return volume;
}

TransferFunction ramp() {
  return {{{10.0, {1.0F, 0.0F, 0.0F}}, {20.0, {0.0F, 0.5F, 1.0F}}},
          {{10.0, 0.0}, {20.0, 0.5}, {30.0, 0.1}},
          {},
          2.0};
}

TEST(TransferFunction, IsLinearBetweenStopsAndConstantBeyond) {
  const TransferFunction function = ramp();
  EXPECT_EQ(colour_at(function, -5.0), glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(colour_at(function, 10.0), glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(colour_at(function, 15.0), glm::vec3(0.5F, 0.25F, 0.5F));
  EXPECT_EQ(colour_at(function, 20.0), glm::vec3(0.0F, 0.5F, 1.0F));
  EXPECT_EQ(colour_at(function, 1e30), glm::vec3(0.0F, 0.5F, 1.0F));
}

// An opacity is that of a layer of the unit length: 1 - exp(-extinction * length).
TEST(TransferFunction, ExtinctionIsThatOfALayerOfTheUnitLength) {
  const TransferFunction function = ramp();
  for (const auto& [value, opacity] : std::vector<std::pair<double, double>>{
           {10.0, 0.0}, {12.0, 0.1}, {20.0, 0.5}, {25.0, 0.3}, {30.0, 0.1}, {99.0, 0.1}}) {
    const double extinction = extinction_at(function, value, kNoGradient);
    EXPECT_NEAR(1.0 - std::exp(-extinction * 2.0), opacity, 1e-15) << value;
  }
  TransferFunction longer = function;
  longer.unit_length = 8.0;
  EXPECT_DOUBLE_EQ(extinction_at(longer, 20.0, kNoGradient),
                   0.25 * extinction_at(function, 20.0, kNoGradient));
}

TEST(TransferFunction, AnOpacityOfOneIsNotInfinite) {
  const TransferFunction function{{{0.0, glm::vec3(1.0F)}}, {{0.0, 1.0}}, {}, 1.0};
  EXPECT_DOUBLE_EQ(extinction_at(function, 0.0, kNoGradient), -std::log1p(-kMaxOpacity));
}

TEST(TransferFunction, GradientsAreAFactorOfTheExtinction) {
  TransferFunction function = ramp();
  const double whole = extinction_at(function, 20.0, 5.0);
  function.gradients = {{1.0, 0.0}, {3.0, 1.0}};
  EXPECT_EQ(extinction_at(function, 20.0, 0.5), 0.0);
  EXPECT_DOUBLE_EQ(extinction_at(function, 20.0, 2.0), 0.5 * whole);
  EXPECT_DOUBLE_EQ(extinction_at(function, 20.0, 30.0), whole);
}

TEST(TransferFunction, WhatHasNoValueIsTransparent) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TransferFunction function{{{0.0, glm::vec3(1.0F)}}, {{0.0, 0.5}}, {}, 1.0};
  EXPECT_EQ(extinction_at(function, nan, kNoGradient), 0.0);
  EXPECT_TRUE(is_transparent_at(function, nan));
  EXPECT_FALSE(is_transparent_at(function, 0.0));
  EXPECT_TRUE(is_transparent_at(ramp(), 5.0));
  EXPECT_TRUE(is_transparent_at(ramp(), 10.0));
  EXPECT_FALSE(is_transparent_at(ramp(), 10.5));
}

TEST(TransferPresets, AreAscendingAndBelowAnOpacityOfOne) {
  const ScalarVolume volume = line_of({0, 1, 2, 3, 50, 51, 52, 99, 100});
  std::vector<std::string> names{"auto", ""};
  for (const std::string_view name : transfer_presets()) names.emplace_back(name);
  EXPECT_EQ(names.size(), 6U);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const auto function = transfer_function_for(name, volume);
    ASSERT_TRUE(function) << function.error().message;
    ASSERT_FALSE(function->colours.empty());
    ASSERT_FALSE(function->opacities.empty());
    EXPECT_GT(function->unit_length, 0.0);
    for (std::size_t k = 1; k < function->colours.size(); ++k)
      EXPECT_GT(function->colours[k].value, function->colours[k - 1].value);
    for (std::size_t k = 0; k < function->opacities.size(); ++k) {
      EXPECT_GE(function->opacities[k].opacity, 0.0);
      EXPECT_LE(function->opacities[k].opacity, kMaxOpacity);
      if (k > 0) {
        EXPECT_GT(function->opacities[k].at, function->opacities[k - 1].at);
      }
    }
  }
}

// Hounsfield units: air is -1000, water 0, bone 300 and more.
TEST(TransferPresets, OfComputedTomographyKnowAirWaterAndBone) {
  const ScalarVolume any = line_of({0, 1});
  const auto bone = transfer_function_for("ct-bone", any);
  const auto skin = transfer_function_for("ct-skin", any);
  ASSERT_TRUE(bone && skin);
  for (const auto* const function : {&*bone, &*skin}) {
    EXPECT_TRUE(is_transparent_at(*function, -1000.0));
    EXPECT_GT(extinction_at(*function, 1000.0, kNoGradient), 0.5) << "a millimetre of bone hides";
    EXPECT_EQ(function->unit_length, 1.0) << "millimetres, whatever the spacing";
  }
  EXPECT_TRUE(is_transparent_at(*bone, 50.0));
  EXPECT_FALSE(is_transparent_at(*skin, 50.0));
}

TEST(TransferPresets, NoneShowsNoValue) {
  const auto none = transfer_function_for("none", line_of({0, 1}));
  ASSERT_TRUE(none);
  for (const double value : {-1e30, 0.0, 1.0, 1e30}) EXPECT_TRUE(is_transparent_at(*none, value));
}

TEST(TransferPresets, OfMagneticResonanceAreFainterThanTheHistograms) {
  const ScalarVolume volume = line_of({0, 1, 2, 50, 60, 70});
  const auto usual = transfer_function_for("auto", volume);
  const auto mr = transfer_function_for("mr", volume);
  ASSERT_TRUE(usual && mr);
  for (std::size_t k = 0; k < mr->opacities.size(); ++k)
    EXPECT_DOUBLE_EQ(mr->opacities[k].opacity, 0.4 * usual->opacities[k].opacity);
}

TEST(TransferPresets, AnUnknownNameIsAnsweredWithThoseThatAre) {
  const auto function = transfer_function_for("bones", line_of({0, 1}));
  ASSERT_FALSE(function);
  EXPECT_EQ(function.error().message,
            "there is no transfer function bones; take auto, ct-bone, ct-skin, mr, none, or a "
            ".json file");
}

TEST(TransferOfHistogram, ShowsWhatIsAboveTheBackground) {
  // 900 nodes of noise from 0 to 9, and 100 of an object from 200 to 209.
  std::vector<float> values;
  for (int n = 0; n < 900; ++n) values.push_back(static_cast<float>(n % 10));
  for (int n = 0; n < 100; ++n) values.push_back(static_cast<float>(200 + n % 10));
  const TransferFunction function = transfer_from_histogram(line_of(values, 0.25));
  // It begins 15 % of the way below the threshold, which is just above the noise.
  for (int value = 0; value < 10; ++value)
    EXPECT_LT(extinction_at(function, value, kNoGradient) * function.unit_length, 1e-3) << value;
  EXPECT_TRUE(is_transparent_at(function, 8.0));
  for (int value = 200; value < 210; ++value)
    EXPECT_FALSE(is_transparent_at(function, value)) << value;
  EXPECT_GT(extinction_at(function, 209.0, kNoGradient), extinction_at(function, 200.0, 0.0));
  EXPECT_DOUBLE_EQ(function.unit_length, 0.25) << "the spacing";
}

TEST(TransferOfHistogram, LeavesOutWhatIsNoNumber) {
  std::vector<float> values{0, 1, 2, 100, 101, 102};
  const TransferFunction clean = transfer_from_histogram(line_of(values));
  values.push_back(std::numeric_limits<float>::quiet_NaN());
  values.push_back(std::numeric_limits<float>::infinity());
  const TransferFunction dirty = transfer_from_histogram(line_of(values));
  ASSERT_EQ(clean.opacities.size(), dirty.opacities.size());
  for (std::size_t k = 0; k < clean.opacities.size(); ++k)
    EXPECT_EQ(clean.opacities[k].at, dirty.opacities[k].at);
}

TEST(TransferOfHistogram, IsDefinedForAnyRangeOfValues) {
  const float most = std::numeric_limits<float>::max();
  for (const std::vector<float>& values : std::vector<std::vector<float>>{
           {7, 7, 7}, {-most, most, 0}, {0, std::numeric_limits<float>::denorm_min()}, {-3}}) {
    const TransferFunction function = transfer_from_histogram(line_of(values));
    for (const float value : values) {
      const double extinction = extinction_at(function, static_cast<double>(value), kNoGradient);
      EXPECT_TRUE(extinction >= 0.0 && std::isfinite(extinction)) << value;
    }
  }
  const TransferFunction same = transfer_from_histogram(line_of({7, 7, 7}));
  EXPECT_FALSE(is_transparent_at(same, 7.0)) << "a volume of one value is seen";
}

class TransferFile : public testing::Test {
 protected:
  Result<TransferFunction> read(const std::string& text) {
    test::spill(path_, text);
    return read_transfer_function(path_, 0.5);
  }
  /// The error without the file's name, which must begin it.
  std::string error_of(const std::string& text) {
    const auto function = read(text);
    if (function) return "no error";
    const std::string& message = function.error().message;
    const std::string name = path_.string() + ": ";
    EXPECT_TRUE(message.starts_with(name)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(std::min(name.size(), message.size()));
  }

  test::ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "function.json";
};

TEST_F(TransferFile, HasColoursOpacitiesGradientsAndAUnitLength) {
  const auto function = read(R"({"colour": [[40, 0.7, 0.4, 0.3], [200, 1, 1, 0.95]],
      "opacity": [[30, 0], [60, 0.05], [200, 0.6]],
      "gradient_opacity": [[0, 0.2], [20, 1]], "unit_length": 3})");
  ASSERT_TRUE(function) << function.error().message;
  ASSERT_EQ(function->colours.size(), 2U);
  EXPECT_EQ(function->colours[0].value, 40.0);
  EXPECT_EQ(function->colours[0].colour.g, linear_from_srgb(0.4F)) << "encoded sRGB in the file";
  ASSERT_EQ(function->opacities.size(), 3U);
  EXPECT_EQ(function->opacities[2].opacity, 0.6);
  ASSERT_EQ(function->gradients.size(), 2U);
  EXPECT_EQ(function->gradients[1].at, 20.0);
  EXPECT_EQ(function->unit_length, 3.0);
}

TEST_F(TransferFile, TheUnitLengthIsTheSpacingByDefault) {
  const std::string text = R"({"colour": [[0, 1, 1, 1]], "opacity": [[0, 0.5]]})";
  const auto function = read(text);
  ASSERT_TRUE(function) << function.error().message;
  EXPECT_EQ(function->unit_length, 0.5);
  EXPECT_TRUE(function->gradients.empty());
  const auto named = transfer_function_for(path_.string(), line_of({0, 1}, 0.125));
  ASSERT_TRUE(named) << named.error().message;
  EXPECT_DOUBLE_EQ(named->unit_length, 0.125);
}

TEST_F(TransferFile, SaysWhatIsWrong) {
  const auto with = [](const std::string& colour, const std::string& opacity,
                       const std::string& more = "") {
    return fmt::format(R"({{"colour": {}, "opacity": {}{}}})", colour, opacity, more);
  };
  const std::string white = "[[0, 1, 1, 1]]";
  const std::string half = "[[0, 0.5]]";
  EXPECT_EQ(error_of(with(white, half)), "no error");
  EXPECT_EQ(error_of(R"({"opacity": [[0, 0.5]]})"),
            "colour: is missing; expected a list of [value, r, g, b]");
  EXPECT_EQ(error_of(R"({"colour": [[0, 1, 1, 1]]})"),
            "opacity: is missing; expected a list of [value, opacity]");
  EXPECT_EQ(error_of(with("[]", half)),
            "colour: expected a list of stops, at least one; found an empty list");
  EXPECT_EQ(error_of(with("[[0, 1, 1]]", half)),
            "colour[0]: expected [value, r, g, b], encoded sRGB, each from 0 to 1; found a list");
  EXPECT_EQ(error_of(with("[[0, 1, 1, 1.5]]", half)),
            "colour[0]: expected [value, r, g, b], encoded sRGB, each from 0 to 1; found a list");
  EXPECT_EQ(error_of(with("[[0, 1, 1, 1], [0, 0, 0, 0]]", half)),
            "colour[1]: the stops' values ascend; this one is not above the one before");
  EXPECT_EQ(error_of(with(white, "[[0, 1]]")),
            "opacity[0]: expected [value, opacity], the opacity from 0 to 0.9999; found a list");
  EXPECT_EQ(error_of(with(white, "[[0, -0.1]]")),
            "opacity[0]: expected [value, opacity], the opacity from 0 to 0.9999; found a list");
  EXPECT_EQ(error_of(with(white, R"([["a", 0.1]])")),
            "opacity[0][0]: expected a number from -1e+30 to 1e+30; found \"a\"");
  EXPECT_EQ(error_of(with(white, "[[1e31, 0.1]]")),
            "opacity[0][0]: expected a number from -1e+30 to 1e+30; found 1e+31");
  EXPECT_EQ(error_of(with(white, half, R"(, "gradient_opacity": [[0, 1.5]])")),
            "gradient_opacity[0]: expected [magnitude, factor], the factor from 0 to 1; found a "
            "list");
  EXPECT_EQ(error_of(with(white, half, R"(, "unit_length": 0)")),
            "unit_length: expected a length in world units from 1e-12 to 1e12; found 0");
  EXPECT_EQ(error_of(with(white, half, R"(, "color": 1)")),
            "does not know the key \"color\"; expected colour, opacity, gradient_opacity, "
            "unit_length");
  EXPECT_EQ(error_of("[]"),
            "expected an object with colour, opacity, gradient_opacity, unit_length; found an "
            "empty list");
  EXPECT_EQ(error_of(""), "has 0 bytes; a transfer function has 1 to 1048576");
  EXPECT_TRUE(error_of("{").starts_with("line 1, column 2: is no JSON")) << error_of("{");
}

TEST_F(TransferFile, HasAtMost4096Stops) {
  const auto with_stops = [](int count) {
    std::string text = R"({"colour": [[0, 1, 1, 1]], "opacity": [[0, 0.5])";
    for (int k = 1; k < count; ++k) text += fmt::format(", [{}, 0.5]", k);
    return text + "]}";
  };
  EXPECT_EQ(error_of(with_stops(4096)), "no error");
  EXPECT_EQ(error_of(with_stops(4097)), "opacity: has 4097 stops; at most 4096 are read");
}

TEST_F(TransferFile, ThatIsNotThereOrTooLargeIsNotRead) {
  const auto missing = read_transfer_function(folder_ / "none.json", 1.0);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("none.json"), std::string::npos);
  EXPECT_EQ(error_of(std::string((1U << 20U) + 1, ' ')),
            "has 1048577 bytes; a transfer function has 1 to 1048576");
}

}  // namespace
}  // namespace relief
