// Films along a camera path, through the command alone.
#include <nlohmann/json.hpp>

#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

class CameraPathCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(run_relief({"convert", write_knot(1500), "-o", path("knot.relief")}).exit_code, 0);
  }
  /// `relief render` of the knot, small.
  [[nodiscard]] Outcome render(const std::string& output,
                               const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"render", path("knot.relief"), "-o", path(output), "--size",
                                       "48x32"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_relief(arguments);
  }
  [[nodiscard]] std::string write_path(const std::string& more = "") const {
    return write("path.json", R"({"version": 1, "keys": [
      {"eye": [0, -9, 2], "target": [0, 0, 0], "up": [0, 0, 1]},
      {"eye": [9, 0, 2], "target": [0.5, 0, 0], "up": [0, 0, 1], "fov": 30}])" +
                                  more + "}");
  }
};

TEST_F(CameraPathCommand, HasAsManyFramesAsSecondsTimesTheRateFromKeyToKey) {
  const Outcome made = render("way.png", {"--path", write_path(), "--fps", "2", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["frames"], 4);
  EXPECT_EQ(files(),
            (std::vector<std::string>{"knot.ply", "knot.relief", "path.json", "way_0000.png",
                                      "way_0001.png", "way_0002.png", "way_0003.png"}));
  ASSERT_EQ(render("first.png", {"--eye", "0,-9,2", "--target", "0,0,0", "--up", "z"}).exit_code,
            0);
  ASSERT_EQ(
      render("last.png", {"--eye", "9,0,2", "--target", "0.5,0,0", "--up", "z", "--fov", "30"})
          .exit_code,
      0);
  EXPECT_EQ(file_bytes(path("way_0000.png")), file_bytes(path("first.png")));
  EXPECT_EQ(file_bytes(path("way_0003.png")), file_bytes(path("last.png")));
  EXPECT_NE(file_bytes(path("way_0001.png")), file_bytes(path("first.png")));
}

TEST_F(CameraPathCommand, TakesItsRateFromTheFileUnlessOneIsNamed) {
  const auto frames = [this](const std::vector<std::string>& more) {
    std::vector<std::string> options{"--path", write_path(R"(, "frames_per_second": 3)"), "--json"};
    options.insert(options.end(), more.begin(), more.end());
    const Outcome made = render("way.png", options);
    return nlohmann::json::parse(made.out, nullptr, false)["frames"].get<int>();
  };
  EXPECT_EQ(frames({}), 6);
  EXPECT_EQ(frames({"--fps", "1"}), 2);
}

TEST_F(CameraPathCommand, RefusesWhatDoesNotGoTogether) {
  const auto refused = [this](const std::string& output, const std::vector<std::string>& more) {
    const Outcome made = render(output, more);
    EXPECT_EQ(made.exit_code, 2) << made.out;
    return made.err;
  };
  const std::string file = write_path();
  EXPECT_NE(refused("a.png", {"--path", file, "--turntable", "4"}).find("excludes"),
            std::string::npos);
  for (const char* option :
       {"--orbit=1,2", "--view=top", "--eye=1,2,3", "--up=z", "--fov=30", "--orthographic=fit"}) {
    EXPECT_NE(refused("a.png", {"--path", file, option}).find("--path: has cameras"),
              std::string::npos)
        << option;
  }
  EXPECT_NE(refused("a.png", {"--fps", "3"}).find("--fps: is for a film"), std::string::npos);
  EXPECT_NE(refused("a.mp4", {}).find("--path FILE"), std::string::npos);
}

TEST_F(CameraPathCommand, RefusesAWrongFileInOneSentence) {
  const auto expect = [this](const std::string& text, const std::string& about) {
    expect_refused(
        {"render", path("knot.relief"), "-o", path("a.png"), "--path", write("bad.json", text)},
        about);
  };
  expect("{", "is no JSON");
  expect(R"({"version": 1, "keys": []})", "keys: expected a list of keys");
  expect(R"({"version": 1, "keys": [{"time": 0, "eye": [0, 0, 1], "target": [0, 0, 0],
      "up": [0, 1, 0]}, {"time": 1e5, "eye": [0, 0, 1], "target": [0, 0, 0], "up": [0, 1, 0]}]})",
         "takes 100000 s");
  expect_refused({"render", path("knot.relief"), "-o", path("a.png"), "--path", path("none.json")},
                 "none.json");
}

}  // namespace
}  // namespace relief::test
