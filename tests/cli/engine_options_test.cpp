// Options of engines come from the engines' tables: those of an engine that only this test has work
// on the command line and in scenes.
#include "cli/options/engine_options.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "loader/scene/view_settings.h"
#include "tests/cli/run_relief.h"
#include "tests/renderer/engines/toy/entry.h"

namespace relief::cli {
namespace {

std::vector<EngineEntry> engines_and_toy() {
  std::vector<EngineEntry> all(engines().begin(), engines().end());
  all.push_back(toy::entry());
  return all;
}

const std::vector<EngineEntry>& all_engines() {
  static const std::vector<EngineEntry> all = engines_and_toy();
  return all;
}

/// The settings of a command line; throws CLI::Error if it is wrong.
SceneSettings parsed(const std::string& line) {
  CLI::App app;
  SceneSettings settings;
  add_engine_options(app, settings, all_engines());
  app.parse(line);
  check_engine_options(settings, all_engines());
  return settings;
}

TEST(EngineOptions, OfAnAddedEngineAreParsedAndChecked) {
  const SceneSettings settings = parsed("--engine toy --grey 0.25");
  EXPECT_EQ(settings.engine, "toy");
  EXPECT_EQ(settings.options, (OptionValues{{"grey", 0.25}}));
  EXPECT_THROW(parsed("--engine toy --grey 1.5"), CLI::ValidationError);
  EXPECT_THROW(parsed("--engine toy --grey dark"), CLI::ValidationError);
  EXPECT_THROW(parsed("--engine toy --samples 4"), CLI::ValidationError);
  EXPECT_THROW(parsed("--grey 0.25"), CLI::ValidationError) << "the default engine has no grey";
  EXPECT_THROW(parsed("--engine multipass --primitive cell"), CLI::ValidationError);
  EXPECT_NO_THROW(parsed("--engine multipass --primitive quad"));
}

TEST(EngineOptions, OfAnAddedEngineAreInTheHelp) {
  CLI::App app;
  SceneSettings settings;
  add_engine_options(app, settings, all_engines());
  const std::string help = app.help();
  EXPECT_NE(
      help.find(
          "--engine onepass|multipass|ewa|surfel|raytrace|volume|volume-reference|volume-truth|"
          "toy"),
      std::string::npos)
      << help;
  const std::size_t group = help.find("Options of toy:\n");
  ASSERT_NE(group, std::string::npos) << help;
  EXPECT_NE(help.find("Linear brightness of a sample, 0 to 1 (default 0.5)", group),
            std::string::npos)
      << help;
  EXPECT_NE(list_engines(all_engines()).find("  toy              draws each sample as one pixel\n"),
            std::string::npos);
}

class EngineOptionsInScenes : public test::CliTest {};

TEST_F(EngineOptionsInScenes, OfAnAddedEngineGoFromSceneToViewToCommandLine) {
  const std::string scene = write("scene.json", R"({"models": [{"file": "a.relief"}],
      "engine": "toy", "grey": 0.25, "samples": 4,
      "views": [{"name": "a"}, {"name": "b", "grey": 0.75}, {"name": "c", "engine": "raytrace"}]})");
  const auto greys = [&scene](const SceneSettings& overrides) {
    std::vector<OptionValues> found;
    const auto plan = plan_scene(scene, overrides, all_engines());
    EXPECT_TRUE(plan) << plan.error().message;
    const auto views = render_settings_of(*plan, PatchModel{}, all_engines());
    EXPECT_TRUE(views) << views.error().message;
    for (const RenderSettings& view : *views) found.push_back(view.options);
    EXPECT_EQ(views->back().raytrace.samples, 4);
    return found;
  };
  EXPECT_EQ(greys({}), (std::vector<OptionValues>{{{"grey", 0.25}}, {{"grey", 0.75}}, {}}));
  SceneSettings overrides;
  overrides.options = {{"grey", 0.5}};
  EXPECT_EQ(greys(overrides), (std::vector<OptionValues>{{{"grey", 0.5}}, {{"grey", 0.5}}, {}}));
  EXPECT_FALSE(plan_scene(scene, {})) << "the registry has no engine toy";
}

TEST_F(EngineOptionsInScenes, OfAViewsEngineAreCheckedAgainstItsOwnTable) {
  const std::string scene = write("scene.json", R"({"models": [{"file": "a.relief"}],
      "views": [{"name": "top", "engine": "multipass", "primitive": "cell"}]})");
  const auto plan = plan_scene(scene, {});
  ASSERT_TRUE(plan) << plan.error().message;
  const auto views = render_settings_of(*plan, PatchModel{});
  ASSERT_FALSE(views);
  EXPECT_EQ(views.error().message, scene +
                                       ": view top: primitive of engine multipass: expected "
                                       "quad, sprite; found cell");
}

}  // namespace
}  // namespace relief::cli
