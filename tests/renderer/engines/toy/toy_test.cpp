// An engine is a folder and a line: this one is added to the registry's, and drawn through the
// public render path.
#include <gtest/gtest.h>

#include <vector>

#include "renderer/engine_registry.h"
#include "tests/renderer/engines/toy/entry.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

std::vector<EngineEntry> engines_and_toy() {
  std::vector<EngineEntry> all(engines().begin(), engines().end());
  all.push_back(toy::entry());  // the line
  return all;
}

/// A single sample at the origin, seen from straight above: the middle of the image.
PatchModel one_sample() {
  PatchModel model = test::sphere_model({.patches_per_side = 1});
  Patch patch = model.patches.front();
  patch.heights.assign(std::size_t{patch.width} * patch.height, kHole);
  patch.heights.front() = 0;
  model.patches = {patch};
  return model;
}

TEST(ToyEngine, DrawsEachSampleAsOnePixel) {
  const std::vector<EngineEntry> all = engines_and_toy();
  const PatchModel model = one_sample();
  const glm::dvec3 sample = position_of(model.patches.front(), 0, 0);
  RenderSettings settings = default_settings(*find_engine("toy", all));
  settings.width = settings.height = 5;
  settings.camera = {sample + glm::dvec3(0.0, 0.0, 3.0), sample, {0.0, 1.0, 0.0}, 45.0};
  ASSERT_TRUE(apply_options(all.back(), {{"grey", 0.25}}, settings));
  Progress silent;
  const auto result = render(RenderModel::of(model), settings, silent, all);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->renderer, "toy");
  EXPECT_EQ(result->covered_pixels, 1U);
  std::vector<float> expected(25, 0.0F);
  expected[12] = 0.25F;
  for (const char* channel : {"R", "G", "B"})
    EXPECT_EQ(test::values(result->image, channel), expected) << channel;
}

TEST(ToyEngine, IsCheckedAndListedByItsEntry) {
  const std::vector<EngineEntry> all = engines_and_toy();
  const PatchModel model = one_sample();
  RenderSettings settings = default_settings(all.back());
  Progress silent;
  // Its entry does not say that it draws these.
  settings.constants.opacity = 0.5F;
  const auto refused = render(RenderModel::of(model), settings, silent, all);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("engine ewa"), std::string::npos);
  EXPECT_EQ(refused.error().message.find("toy"), std::string::npos);
  // Its option is one of all, beside those of the others.
  const std::vector<SharedOption> options = shared_options(all);
  const auto grey = std::find_if(options.begin(), options.end(),
                                 [](const SharedOption& o) { return o.row.key == "grey"; });
  ASSERT_NE(grey, options.end());
  EXPECT_EQ(grey->engines.front()->name, "toy");
  EXPECT_FALSE(apply_options(all.back(), {{"grey", 2.0}}, settings));
  EXPECT_FALSE(apply_options(all.back(), {{"radius-factor", 2.0}}, settings));
  // Without the line there is no such engine.
  const auto missing = render(RenderModel::of(model), settings, silent);
  ASSERT_FALSE(missing);
  EXPECT_EQ(
      missing.error().message,
      "there is no engine toy; take one of onepass, multipass, ewa, surfel, raytrace, volume, "
      "volume-reference, volume-truth");
}

TEST(EngineRegistry, DefaultsAreThoseOfTheTables) {
  for (const EngineEntry& engine : engines()) {
    const RenderSettings settings = default_settings(engine);
    for (const EngineOption& option : engine.options) {
      const auto value = option.get(settings);
      if (!value) {
        // Off, or for other settings to decide: the table names no value, or one that changes
        // nothing.
        if (const auto unset = parse_value(option.row, option.row.default_text)) {
          RenderSettings same = settings;
          ASSERT_TRUE(apply_options(engine, {{option.row.key, *unset}}, same));
          EXPECT_FALSE(option.get(same)) << engine.name << " " << option.row.key;
        }
        continue;
      }
      const auto written = parse_value(option.row, option.row.default_text);
      if (written) {
        EXPECT_EQ(*written, *value) << engine.name << " " << option.row.key;
      }
      // What is put in comes out.
      const OptionValue other =
          option.row.kind == OptionKind::Choice ? OptionValue(option.row.choices.back())
          : option.row.kind == OptionKind::Text ? OptionValue("another.json")
                                                : OptionValue(option.row.range.max);
      RenderSettings changed = settings;
      ASSERT_TRUE(apply_options(engine, {{option.row.key, other}}, changed));
      EXPECT_EQ(option.get(changed), other) << engine.name << " " << option.row.key;
    }
  }
}

}  // namespace
}  // namespace relief
