// relief convert --scalars and relief render --colour-by: from a scan's numbers to a picture.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "common/scalars/colour_map.h"
#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using nlohmann::json;

class ColourByTest : public JsonTest {
 protected:
  /// A tilted square of 40 x 40 points at UTM coordinates, with an intensity that grows with x and
  /// classes 2 and 6.
  std::string write_square() {
    std::ofstream file(path("square.csv"));
    file << "x,y,z,Intensity,Class\n";
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        file << 500000 + x << ',' << 4918340 + y << ',' << 200.0 + 0.5 * y << ',' << 100 + 10 * x
             << ',' << (x < 20 ? 2 : 6) << '\n';
      }
    }
    return path("square.csv");
  }

  /// Renders an unlit PNG without anything behind, seen from above, and counts its opaque colours.
  std::map<std::uint32_t, std::size_t> colours_of(const std::string& scene,
                                                  std::vector<std::string> more) {
    std::vector<std::string> arguments{
        "render",  scene,  "-o",   path("a.png"), "--material", "unlit",   "--samples",    "1",
        "--orbit", "0,90", "--up", "z",           "--size",     "320x256", "--background", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto image = read_image(path("a.png"));
    EXPECT_TRUE(image);
    std::map<std::uint32_t, std::size_t> colours;
    if (!image) return colours;
    for (std::size_t k = 0; k < image->channels[0].values.size(); ++k) {
      if (image->find("A")->values[k] < 1.0F) continue;
      const glm::u8vec3 c = srgb8_from_linear(glm::vec3(
          image->find("R")->values[k], image->find("G")->values[k], image->find("B")->values[k]));
      ++colours[c.r << 16U | c.g << 8U | c.b];
    }
    return colours;
  }

  static std::uint32_t packed(glm::u8vec3 c) { return c.r << 16U | c.g << 8U | c.b; }
};

TEST_F(ColourByTest, ScalarsAreKeptAndListed) {
  const std::string scan = write_square();
  for (const char* codec : {"fast", "compact"}) {
    run_json({"convert", scan, "-o", path("a.relief"), "--scalars", "intensity,class,distance",
              "--codec", codec});
    const json info = run_json({"info", path("a.relief"), "--verify"});
    ASSERT_EQ(info["scalars"].size(), 3U);
    EXPECT_EQ(info["scalars"][0]["name"], "intensity");
    EXPECT_EQ(info["scalars"][0]["min"], 100);
    EXPECT_EQ(info["scalars"][0]["max"], 490);
    EXPECT_EQ(info["scalars"][1]["name"], "classification");
    EXPECT_EQ(info["scalars"][1]["label"], true);
    EXPECT_EQ(info["scalars"][2]["name"], "distance");
    EXPECT_GT(info["scalar_bytes"], 0);
    EXPECT_NE(run_relief({"info", path("a.relief")}).out.find("classification: 2 to 6"),
              std::string::npos);
  }
  run_json({"convert", scan, "-o", path("none.relief")});
  const json none = run_json({"info", path("none.relief")});
  EXPECT_TRUE(none["scalars"].empty());
  EXPECT_EQ(none["scalar_bytes"], 0);
}

TEST_F(ColourByTest, NumbersHaveTheColoursOfTheMap) {
  const std::string scan = write_square();
  run_json({"convert", scan, "-o", path("a.relief"), "--scalars", "all"});
  for (const std::string& scene : {scan, path("a.relief")}) {
    const json report = run_json({"render", scene, "-o", path("b.png"), "--colour-by", "Intensity",
                                  "--colour-range", "100,490", "--colour-map", "plasma"});
    EXPECT_EQ(report["colour_by"], json::parse(R"({"scalar": "intensity", "low": 100.0,
                                                   "high": 490.0, "map": "plasma"})"));
    const auto colours =
        colours_of(scene, {"--colour-by", "intensity", "--colour-map", "grey", "--no-legend"});
    EXPECT_GT(colours.size(), 200U);
    for (const auto& [colour, count] : colours) {
      // Greys: bilinear lookups between two of them are grey, too.
      EXPECT_EQ(colour >> 16U, colour & 0xFFU) << std::hex << colour;
    }
  }
}

TEST_F(ColourByTest, LabelsAreNeverMixed) {
  const std::string scan = write_square();
  run_json({"convert", scan, "-o", path("a.relief"), "--scalars", "class"});
  for (const std::string& scene : {scan, path("a.relief")}) {
    const auto colours = colours_of(scene, {"--colour-by", "class", "--no-legend"});
    ASSERT_EQ(colours.size(), 2U);
    EXPECT_TRUE(colours.contains(packed(las_class_colour(2))));
    EXPECT_TRUE(colours.contains(packed(las_class_colour(6))));
    const json report = run_json({"render", scene, "-o", path("b.png"), "--colour-by", "class"});
    EXPECT_EQ(report["colour_by"]["labels"], json({2, 6}));
  }
  // With a map they are numbers.
  const json mapped = run_json(
      {"render", scan, "-o", path("b.png"), "--colour-by", "class", "--colour-map", "turbo"});
  EXPECT_EQ(mapped["colour_by"]["high"], 6.0);
}

TEST_F(ColourByTest, HeightFollowsTheUpDirection) {
  const std::string scan = write_square();
  run_json({"convert", scan, "-o", path("a.relief"), "--up", "z"});
  for (const std::string& scene : {scan, path("a.relief")}) {
    const json z = run_json({"render", scene, "-o", path("b.png"), "--colour-by", "height", "--up",
                             "z", "--colour-range", "0%,100%"});
    EXPECT_NEAR(z["colour_by"]["low"].get<double>(), 200.0, 0.1);
    EXPECT_NEAR(z["colour_by"]["high"].get<double>(), 219.5, 0.5);
    const json x = run_json({"render", scene, "-o", path("b.png"), "--colour-by", "height", "--up",
                             "x", "--colour-range", "0%,100%"});
    EXPECT_NEAR(x["colour_by"]["low"].get<double>(), 500000.0, 1.0);
  }
}

TEST_F(ColourByTest, EveryEngineDrawsIt) {
  const std::string scan = write_square();
  for (const char* engine : {"onepass", "multipass", "ewa", "raytrace"}) {
    const json report = run_json({"render", scan, "-o", path("b.png"), "--engine", engine, "--size",
                                  "200x160", "--colour-by", "intensity", "--no-legend"});
    EXPECT_EQ(report["colour_by"]["scalar"], "intensity") << engine;
    EXPECT_NEAR(report["colour_by"]["low"].get<double>(), 100.0, 10.0) << engine;
  }
  expect_refused(
      {"render", scan, "-o", path("c.png"), "--engine", "ewa", "--colour-by", "distance"},
      "draws the points");
}

TEST_F(ColourByTest, TheLegendIsInAPngAndNotInAnExr) {
  const std::string scan = write_square();
  const auto with = colours_of(scan, {"--colour-by", "class"});
  EXPECT_GT(with.size(), 10U) << "a panel and letters";
  run_json({"render", scan, "-o", path("b.exr"), "--colour-by", "class", "--material", "unlit",
            "--samples", "1", "--background", "none"});
  const auto exr = read_image(path("b.exr"));
  ASSERT_TRUE(exr);
  EXPECT_EQ(exr->find("A")->values.back(), 0.0F);
  const Outcome tiny =
      run_relief({"render", scan, "-o", path("t.png"), "--colour-by", "class", "--size", "60x40"});
  EXPECT_EQ(tiny.exit_code, 0);
  EXPECT_NE(tiny.err.find("too small for a legend"), std::string::npos) << tiny.err;
}

TEST_F(ColourByTest, PointsAreExportedWithTheirScalars) {
  const std::string scan = write_square();
  run_json({"convert", scan, "-o", path("a.relief"), "--scalars", "all"});
  run_json({"export", path("a.relief"), "-o", path("a.ply")});
  run_json({"convert", path("a.ply"), "-o", path("b.relief"), "--scalars", "all"});
  const json info = run_json({"info", path("b.relief")});
  ASSERT_EQ(info["scalars"].size(), 2U);
  EXPECT_EQ(info["scalars"][0]["max"], 490);
  EXPECT_EQ(info["scalars"][1]["label"], true);
}

TEST_F(ColourByTest, MissingScalarsAreNamed) {
  const std::string scan = write_square();
  run_json({"convert", scan, "-o", path("a.relief"), "--scalars", "class"});
  expect_refused({"render", path("a.relief"), "-o", path("c.png"), "--colour-by", "intensity"},
                 "has no scalar 'intensity'; it has classification");
  expect_refused({"render", scan, "-o", path("c.png"), "--colour-by", "echo"},
                 "has no scalar 'echo'; it has intensity, classification");
  expect_refused({"convert", scan, "-o", path("c.relief"), "--scalars", "echo"},
                 "has no scalar 'echo'; it has intensity, classification");
  expect_refused({"render", scan, "-o", path("c.png"), "--colour-by", "intensity", "--colour-range",
                  "600,98%"},
                 "the range of intensity is empty");
}

TEST_F(ColourByTest, WrongOptionsAreWrongUsage) {
  const std::string scan = write_square();
  const auto refuses = [&](std::vector<std::string> more, const std::string& about) {
    std::vector<std::string> arguments{"render", scan, "-o", path("c.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 2) << about;
    EXPECT_NE(run.err.find(about), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("c.png")));
  };
  refuses({"--colour-map", "viridis"}, "--colour-by");
  refuses({"--no-legend"}, "--colour-by");
  refuses({"--colour-by", "z", "--colour-map", "jet"}, "viridis");
  refuses({"--colour-by", "z", "--colour-range", "5"}, "LO,HI");
  refuses({"--colour-by", "z", "--colour-range", "5,1"}, "below its second");
  refuses({"--colour-by", "z", "--colour-range", "nan,1"}, "neither a number");
  refuses({"--colour-by", "z", "--colour-range", "0%,101%"}, "neither a number");
  refuses({"--colour-by", ""}, "name of a scalar");
  write("s.json", R"({"models": [{"file": "square.csv"}], "views": [{"name": "v"}]})");
  EXPECT_EQ(
      run_relief({"render", path("s.json"), "-o", path("c.png"), "--colour-by", "z"}).exit_code, 2);
  for (const char* names : {"", "a,,b", "height"})
    EXPECT_EQ(
        run_relief({"convert", scan, "-o", path("c.relief"), std::string("--scalars=") + names})
            .exit_code,
        2)
        << names;
  expect_refused(
      {"convert", scan, "-o", path("c.relief"), "--scalars", "distance", "--memory", "1G"},
      "not kept in tiles");
}

}  // namespace
}  // namespace relief::test
