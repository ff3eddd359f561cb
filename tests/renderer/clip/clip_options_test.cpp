// The options of clip partners: what they accept, and which engines have them.
#include <gtest/gtest.h>

#include <string>

#include "renderer/clip/options.h"
#include "renderer/engine_registry.h"
#include "renderer/render.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

Status apply(const std::string& engine, const std::string& key, const std::string& value,
             RenderSettings& settings) {
  return apply_options(*find_engine(engine), {{key, value}}, settings);
}

TEST(ClipOptions, AreOffByDefault) {
  for (const char* const name : {"ewa", "multipass"}) {
    const EngineEntry& engine = *find_engine(name);
    const RenderSettings settings = default_settings(engine);
    EXPECT_EQ(settings.clip, ClipSettings{});
    for (const char* const key : {"clip-partners", "clip-threshold", "clip-normals"}) {
      const EngineOption* const option = find_option(engine, key);
      ASSERT_NE(option, nullptr) << key;
      EXPECT_FALSE(option->get(settings)) << key;
    }
  }
}

TEST(ClipOptions, SetWhatTheyName) {
  RenderSettings settings;
  ASSERT_TRUE(apply("ewa", "clip-partners", "independent", settings));
  ASSERT_TRUE(apply("ewa", "clip-threshold", "-0.25", settings));
  ASSERT_TRUE(apply("ewa", "clip-normals", "refit", settings));
  EXPECT_EQ(settings.clip, (ClipSettings{ClipRule::Independent, -0.25, ClipNormals::Refit}));
  const EngineOption* const threshold = find_option(*find_engine("ewa"), "clip-threshold");
  EXPECT_EQ(std::get<std::string>(*threshold->get(settings)), "-0.25");
  ASSERT_TRUE(apply("ewa", "clip-threshold", "auto", settings));
  EXPECT_FALSE(settings.clip.threshold);
  EXPECT_EQ(std::get<std::string>(*threshold->get(settings)), "auto");
}

TEST(ClipOptions, RefuseOtherValues) {
  for (const char* const value : {"", "on", "Partners", "1"}) {
    RenderSettings settings;
    EXPECT_FALSE(apply("ewa", "clip-partners", value, settings)) << value;
  }
  for (const char* const value : {"", "1.01", "-2", "nan", "inf", "0.5x", "half"}) {
    RenderSettings settings;
    const Status status = apply("multipass", "clip-threshold", value, settings);
    ASSERT_FALSE(status) << value;
    EXPECT_NE(status.error().message.find("auto or a number from -1 to 1"), std::string::npos)
        << status.error().message;
  }
}

TEST(ClipOptions, EnginesWithoutThemRefuseTheOutput) {
  const PatchModel model = test::height_field(8, [](double, double) { return 0.0; });
  RenderSettings settings = test::small_image(model);
  settings.outputs.clip = true;
  Progress silent;
  for (const char* const name : {"onepass", "raytrace"}) {
    settings.engine = name;
    const auto result = render(model, settings, silent);
    ASSERT_FALSE(result) << name;
    EXPECT_NE(result.error().message.find("has no output clip, which engine multipass"),
              std::string::npos)
        << result.error().message;
  }
}

}  // namespace
}  // namespace relief
