// --quality of relief convert and relief render: presets, and options that win over them.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

json parsed(const Outcome& run) {
  EXPECT_EQ(run.exit_code, 0) << run.err;
  json out = json::parse(run.out, nullptr, false);
  EXPECT_TRUE(out.is_object()) << run.out;
  return out;
}

class QualityOption : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    scan_ = write_knot(3000);
  }

  /// The bytes of the patch file that these options make.
  std::string converted(const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"convert", scan_, "-o", path("out.relief")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(run_relief(arguments).exit_code, 0);
    return file_bytes(path("out.relief"));
  }

  json rendered(const std::string& scene, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", scene,   "-o",    path("out.png"),
                                       "--size", "48x40", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return parsed(run_relief(arguments));
  }

  std::string scan_;
};

TEST_F(QualityOption, BalancedIsTheDefault) {
  const std::string usual = converted({});
  EXPECT_EQ(converted({"--quality", "balanced"}), usual);
  EXPECT_LT(converted({"--quality", "draft"}).size(), usual.size() / 2);
  const json plain = rendered(path("out.relief"), {});
  const std::string picture = file_bytes(path("out.png"));
  const json balanced = rendered(path("out.relief"), {"--quality", "balanced"});
  EXPECT_EQ(file_bytes(path("out.png")), picture);
  EXPECT_EQ(balanced["samples"], plain["samples"]);
}

TEST_F(QualityOption, OptionsWinInConvert) {
  // Whichever comes first, and also where another option says the same in other words.
  const std::string all_given = converted({"--samples-per-point", "1.5", "--codec", "fast"});
  EXPECT_EQ(converted({"--samples-per-point", "1.5", "--codec", "fast", "--quality", "draft"}),
            all_given);
  EXPECT_EQ(converted({"--quality", "exact", "--samples-per-point", "1.5", "--codec", "fast"}),
            all_given);
  EXPECT_EQ(converted({"--quality", "draft", "--spacing", "0.2", "--codec", "fast"}),
            converted({"--spacing", "0.2", "--codec", "fast"}));
  EXPECT_EQ(converted({"--quality", "draft", "--samples", "2000", "--codec", "fast"}),
            converted({"--samples", "2000", "--codec", "fast"}));
  // What is not given is the preset's.
  EXPECT_NE(converted({"--quality", "draft", "--codec", "fast"}), converted({"--codec", "fast"}));
}

TEST_F(QualityOption, OptionsAndScenesWinInRender) {
  const std::string exact = "exact";
  converted({});
  const std::string file = path("out.relief");
  EXPECT_EQ(rendered(file, {"--quality", "draft"})["samples"], 1);
  EXPECT_EQ(rendered(file, {"--quality", exact})["samples"], 16);
  EXPECT_EQ(rendered(file, {"--quality", exact, "--samples", "9"})["samples"], 9);
  const std::string scene = write(
      "scene.json",
      R"({"models": [{"file": "out.relief"}], "views": [{"name": "a", "samples": 9}, {"name": "b"}]})");
  const json run = parsed(run_relief({"render", scene, "-o", path("{view}.png"), "--size", "48x40",
                                      "--quality", "draft", "--json"}));
  EXPECT_EQ(run["views"][0]["samples"], 9);
  EXPECT_EQ(run["views"][1]["samples"], 1);
}

TEST_F(QualityOption, OtherEnginesKeepTheirDefaults) {
  converted({});
  const json drawn = rendered(path("out.relief"), {"--quality", "draft", "--engine", "multipass"});
  EXPECT_EQ(drawn["samples"], rendered(path("out.relief"), {"--engine", "multipass"})["samples"]);
}

TEST_F(QualityOption, AScanIsConvertedWithIt) {
  // The picture is that of the converted file, but for the compact codec's rounding: the draft has
  // fewer samples, so that it is not the default's picture.
  (void)rendered(scan_, {"--samples", "1", "--pixels-per-sample", "0"});
  const std::string usual = file_bytes(path("out.png"));
  (void)rendered(scan_, {"--samples", "1", "--pixels-per-sample", "0", "--quality", "draft"});
  EXPECT_NE(file_bytes(path("out.png")), usual);
}

TEST_F(QualityOption, RefusesOtherNames) {
  const Outcome run = run_relief({"convert", scan_, "-o", path("out.relief"), "--quality", "best"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("expected draft, balanced or exact; found best"), std::string::npos)
      << run.err;
  EXPECT_EQ(run_relief({"convert", scan_, "-o", path("out.relief"), "--quality", "draft",
                        "--memory", "300M"})
                .exit_code,
            2);
}

TEST_F(QualityOption, StepsPerSpacingIsAHeightStepOfEachPatch) {
  // 20 is the default; more steps store finer heights, which take more bytes.
  const std::string usual = converted({});
  EXPECT_EQ(converted({"--steps-per-spacing", "20"}), usual);
  EXPECT_LT(converted({"--steps-per-spacing", "5"}).size(), usual.size());
  const auto samples = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "convert", scan_, "-o", path("out.relief"), "--json", "--samples-per-point", "0.25"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return parsed(run_relief(arguments))["samples"].get<int>();
  };
  // A quarter of the points, and margins and ragged borders, which weigh more with fewer samples.
  const int few = samples({"--overlap", "1"});
  EXPECT_GT(few, 3000 / 4);
  EXPECT_LT(few, 3000 / 2);
  // Patches that meet have no margins: on a rope this thin they end up to a spacing before others.
  const int meeting = samples({});
  EXPECT_GT(meeting, 3000 / 8);
  EXPECT_LT(meeting, 3000 / 4);
}

}  // namespace
}  // namespace relief::test
