// Scenes of several models and views, through the command alone.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/image/image_io.h"
#include "loader/scene/scene_plan.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

class SceneCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(run_relief({"convert", write_knot(1500), "-o", path("knot.relief")}).exit_code, 0);
  }
  /// Two views of the knot and of a smaller one beside it.
  [[nodiscard]] std::string two_views() const {
    return write("suite.json", R"({
      "models": [{"file": "knot.relief"},
                 {"file": "knot.relief", "transform": {"translation": [8, 0, 0], "scale": 0.5}}],
      "size": [80, 64],
      "views": [{"name": "front", "orbit": [0, 10]},
                {"name": "side", "orbit": [60, 20], "material": "unlit", "primitive": "sprite",
                 "interpolation": "direct", "size": [96, 48]}]})");
  }
  /// A scene that must be refused in one sentence.
  void expect_no_scene(const std::string& text, const std::string& about) const {
    expect_refused({"render", write("bad.json", text), "-o", path("{view}.png")}, about);
  }
  json run_json(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    arguments.insert(arguments.end(), {"--frames", "1"});
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return json::parse(run.out, nullptr, false);
  }
};

std::string scene_of(const std::string& file, const std::string& more = "") {
  return R"({"models": [{"file": ")" + file + R"("}], "views": [{"name": "a"}, {"name": "b"}])" +
         more + "}";
}

TEST_F(SceneCommand, EveryViewIsAnImage) {
  const json result = run_json({"render", two_views(), "-o", path("{view}.exr")});
  ASSERT_EQ(result["views"].size(), 2U);
  const json& front = result["views"][0];
  const json& side = result["views"][1];
  EXPECT_EQ(front["name"], "front");
  EXPECT_EQ(front["output"], path("front.exr"));
  EXPECT_EQ(front["material"], "unlit") << "the knot has colours";
  EXPECT_EQ(front["width"], 80);
  EXPECT_EQ(side["name"], "side");
  EXPECT_EQ(side["material"], "unlit");
  EXPECT_EQ(side["primitive"], "sprite");
  EXPECT_EQ(side["interpolation"], "direct");
  EXPECT_EQ(side["height"], 48);
  EXPECT_EQ(side["engine"], "onepass");
  for (const char* key : {"renderer", "frame_ms", "gpu_ms", "covered_pixels", "fragments"}) {
    EXPECT_TRUE(front.contains(key)) << key;
  }
  const auto image = read_image(path("side.exr"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 96U);
  EXPECT_NE(image->find("patch"), nullptr);
  EXPECT_TRUE(std::filesystem::exists(path("front.exr")));
}

TEST_F(SceneCommand, AModelOfASceneLooksLikeTheModel) {
  const std::string scene = write(
      "one.json", R"({"models": [{"file": "knot.relief"}], "views": [{"name": "a", "fov": 30}]})");
  const std::vector<std::string> options{"--size", "80x64", "--orbit", "20,30", "--fov", "40"};
  std::vector<std::string> with_scene{"render", scene, "-o", path("scene.exr")};
  std::vector<std::string> alone{"render", path("knot.relief"), "-o", path("alone.exr")};
  with_scene.insert(with_scene.end(), options.begin(), options.end());
  alone.insert(alone.end(), options.begin(), options.end());
  const json result = run_json(with_scene);
  EXPECT_EQ(result["views"].size(), 1U);  // also with one view
  EXPECT_TRUE(run_json(alone).contains("engine"));
  ASSERT_FALSE(file_bytes(path("alone.exr")).empty());
  EXPECT_EQ(file_bytes(path("scene.exr")), file_bytes(path("alone.exr")));
}

TEST_F(SceneCommand, AnOrthographicViewIsAsByItsOption) {
  const std::string scene = write("flat.json", R"({"models": [{"file": "knot.relief"}], "fov": 30,
      "size": [80, 64], "views": [{"name": "a", "orthographic": "fit"}, {"name": "b"}]})");
  run_json({"render", scene, "-o", path("{view}.exr")});
  // As one height for all views, which displaces their fields of view.
  run_json({"render", scene, "-o", path("all_{view}.exr"), "--orthographic", "fit"});
  run_json({"render", path("knot.relief"), "-o", path("alone.exr"), "--size", "80x64",
            "--orthographic", "fit"});
  ASSERT_FALSE(file_bytes(path("a.exr")).empty());
  EXPECT_EQ(file_bytes(path("a.exr")), file_bytes(path("alone.exr")));
  EXPECT_EQ(file_bytes(path("all_a.exr")), file_bytes(path("alone.exr")));
  EXPECT_EQ(file_bytes(path("all_b.exr")), file_bytes(path("alone.exr")));
  EXPECT_NE(file_bytes(path("b.exr")), file_bytes(path("a.exr")));
}

TEST_F(SceneCommand, ModelsStandWhereTheirTransformsPutThem) {
  // Of two knots of radius 4, one is moved by 100 and one twice as large and moved by -100.
  const std::string scene = write("far.json", R"({
    "models": [{"file": "knot.relief", "transform": {"translation": [100, 0, 0]}},
               {"file": "knot.relief", "transform": {"translation": [-100, 0, 0], "scale": 2}}],
    "size": [64, 64],
    "views": [{"name": "old", "eye": [0, 0, 12], "target": [0, 0, 0]},
              {"name": "new", "eye": [100, 0, 12], "target": [100, 0, 0]},
              {"name": "large", "eye": [-100, 0, 24], "target": [-100, 0, 0]}]})");
  const json views = run_json({"render", scene, "-o", path("{view}.png")})["views"];
  EXPECT_EQ(views[0]["covered_pixels"], 0);
  EXPECT_GT(views[1]["covered_pixels"], 500);
  // The same image but for pixels at the rim.
  EXPECT_NEAR(views[2]["covered_pixels"], views[1]["covered_pixels"], 5);
}

TEST_F(SceneCommand, TheSampleSceneIsDrawn) {
  write("suite.json", file_bytes(std::string(RELIEF_SOURCE_DIR) + "/models/dragon_views.json"));
  std::filesystem::rename(path("knot.relief"), path("dragon.relief"));
  const json result =
      run_json({"render", path("suite.json"), "-o", path("{view}.png"), "--size", "32x32"});
  EXPECT_EQ(result["views"].size(), 6U);
}

TEST_F(SceneCommand, ModelsHaveMaterialsOfTheirOwnUnlessAnOptionSaysOtherwise) {
  const std::string scene = write("own.json", R"({
    "models": [{"file": "knot.relief", "material": "glass", "ior": 1.3},
               {"file": "knot.relief", "transform": {"translation": [9, 0, 0]}},
               {"file": "knot.relief", "material": "glass", "ior": 1.3}],
    "size": [64, 48], "views": [{"name": "a"}, {"name": "b", "material": "mirror"},
                                {"name": "c", "material": "glass", "ior": 1.3}]})");
  const json views = run_json({"render", scene, "-o", path("{view}.png")})["views"];
  EXPECT_EQ(views[0]["material"], "lit+glass");
  EXPECT_EQ(views[1]["material"], "mirror+glass");
  EXPECT_EQ(views[2]["material"], "glass");
  EXPECT_NE(file_bytes(path("a.png")), file_bytes(path("b.png")));
  const json over = run_json({"render", scene, "-o", path("{view}.png"), "--material", "unlit"});
  for (const json& view : over["views"]) EXPECT_EQ(view["material"], "unlit");
  EXPECT_EQ(file_bytes(path("a.png")), file_bytes(path("b.png")));
}

TEST_F(SceneCommand, ExposureIsOfPngsAlone) {
  const std::vector<std::string> common{"--size", "48x48",        "--material",
                                        "unlit",  "--background", "none"};
  const auto render = [&](const std::string& output, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", path("knot.relief"), "-o", path(output)};
    arguments.insert(arguments.end(), common.begin(), common.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    run_json(arguments);
    return read_image(path(output));
  };
  const auto plain = render("plain.png", {});
  const auto darker = render("darker.png", {"--exposure", "-2"});
  ASSERT_TRUE(plain && darker);
  float brightest = 0.0F;
  for (std::size_t k = 0; k < plain->find("R")->values.size(); ++k) {
    const float value = plain->find("R")->values[k];
    brightest = std::max(brightest, value);
    // Two stops are a quarter of the light; 8 bits round by at most 0.005 of it.
    EXPECT_NEAR(darker->find("R")->values[k], value / 4.0F, 0.005F);
    EXPECT_EQ(darker->find("A")->values[k], plain->find("A")->values[k]);
  }
  EXPECT_GT(brightest, 0.1F);
  // A scene may say it for views that become EXRs, which keep the scene's light.
  const std::string scene = write("exposed.json", scene_of("knot.relief", R"(, "exposure": 3)"));
  run_json({"render", scene, "-o", path("{view}.exr"), "--size", "48x48"});
  run_json({"render", path("knot.relief"), "-o", path("plain.exr"), "--size", "48x48"});
  EXPECT_EQ(file_bytes(path("a.exr")), file_bytes(path("plain.exr")));
}

TEST_F(SceneCommand, TheExampleOfTheDocumentationIsValid) {
  const std::string page = file_bytes(std::string(RELIEF_SOURCE_DIR) + "/docs/scene.md");
  const std::size_t begin = page.find("```json\n") + 8;
  const auto scene =
      plan_scene(write("page.json", page.substr(begin, page.find("```", begin) - begin)), {});
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->models.size(), 2U);
  EXPECT_EQ(scene->views.size(), 3U);
}

TEST_F(SceneCommand, OptionsOverrideEveryView) {
  const json result = run_json({"render", two_views(), "-o", path("{view}.png"), "--size", "32x32",
                                "--material", "mirror", "--orbit", "5,5"});
  for (const json& view : result["views"]) {
    EXPECT_EQ(view["width"], 32);
    EXPECT_EQ(view["material"], "mirror");
  }
  EXPECT_EQ(result["views"][1]["primitive"], "sprite");  // not overridden
}

TEST_F(SceneCommand, PrintsEachImage) {
  const Outcome run = run_relief({"render", two_views(), "-o", path("{view}.png")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find(path("front.png") + "\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(path("side.png") + "\n"), std::string::npos) << run.out;
}

TEST_F(SceneCommand, ViewsWithEqualNamesAreWrongUsage) {
  const std::string scene = two_views();
  const auto before = files();
  const Outcome run = run_relief({"render", scene, "-o", path("out.png")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "relief: " + scene +
                         ": has 2 views; put {view} into the output's name, as in "
                         "out/{view}.exr\n");
  EXPECT_EQ(files(), before);
}

TEST_F(SceneCommand, AViewMayNameExistingFolders) {
  std::filesystem::create_directories(path("front"));
  expect_refused({"render", two_views(), "-o", path("{view}/{view}.png")}, "side.png");
  std::filesystem::create_directories(path("side"));
  run_json({"render", two_views(), "-o", path("{view}/{view}.png")});
  EXPECT_TRUE(std::filesystem::exists(path("front/front.png")));
  EXPECT_TRUE(std::filesystem::exists(path("side/side.png")));
}

TEST_F(SceneCommand, EveryOutputIsCheckedBeforeTheWork) {
  // The second can't be: the first is not made either.
  std::filesystem::create_directory(path("side.png"));
  expect_refused({"render", two_views(), "-o", path("{view}.png")}, "side.png");
  const std::string scene = write("knot.json", scene_of("b.png"));
  write("b.png", "a model by this name");
  expect_refused({"render", scene, "-o", path("{view}.png")}, "b.png: is also the input");
}

TEST_F(SceneCommand, AFailureLeavesWholeImagesAndSaysSo) {
  // Too large a file for the second view alone.
  const std::string scene =
      write("sizes.json",
            R"({"models": [{"file": "knot.relief"}], "views": [{"name": "a", "size": [8, 8]},
                {"name": "b", "size": [400, 400]}]})");
  RunOptions options;
  options.largest_file = 8192;
  const Outcome run =
      run_relief({"render", scene, "-o", path("{view}.exr"), "--frames", "1"}, options);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("b.exr: cannot be written"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("; 1 of 2 images were written\n"), std::string::npos) << run.err;
  EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "knot.ply", "knot.relief", "sizes.json"}));
  EXPECT_TRUE(read_image(path("a.exr")));
}

TEST_F(SceneCommand, AnInterruptLeavesWholeImagesAndSaysSo) {
  std::string views;
  for (int i = 0; i < 60; ++i)
    views += (i > 0 ? ",{\"name\":\"v" : "{\"name\":\"v") + std::to_string(i) + "\"}";
  const std::string scene =
      write("many.json", R"({"models": [{"file": "knot.relief"}], "size": [640, 512], "views": [)" +
                             views + "]}");
  RunOptions options;
  options.terminal = true;
  options.interrupt_at = "render";
  const Outcome run =
      run_relief({"render", scene, "-o", path("{view}.png"), "--frames", "3"}, options);
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("relief: interrupted; "), std::string::npos) << run.err;
  for (const std::string& file : files()) {
    EXPECT_EQ(file.find(".tmp"), std::string::npos) << file;
    if (file.ends_with(".png")) {
      EXPECT_TRUE(read_image(path(file))) << file;
    }
  }
  EXPECT_LT(files().size(), 60U);
}

TEST_F(SceneCommand, RefusesInvalidScenes) {
  expect_no_scene("", "bad.json: the file is empty");
  expect_no_scene("not json at all", "bad.json: line 1, column ");
  const std::string whole = scene_of("knot.relief");
  expect_no_scene(whole.substr(0, whole.size() / 2), "bad.json: line 1, column ");
  expect_no_scene("{\"models\": [\n{]}", "bad.json: line 2, column 2: is no JSON");
  expect_no_scene("[]", "bad.json: expected an object");
  expect_no_scene(R"({"models": [], "views": [{"name": "a"}]})", "bad.json: models: expected");
  expect_no_scene(R"({"models": [{"file": "knot.relief"}], "views": []})",
                  "bad.json: views: expected");
  expect_no_scene(R"({"models": [{"file": "knot.relief"}], "views": [{"name": "../a"}]})",
                  "bad.json: views[0].name: expected");
  expect_no_scene(scene_of("knot.relief", R"(, "sparkle": 1)"),
                  "bad.json: does not know the key \"sparkle\"");
  expect_no_scene(std::string(100000, '['), "bad.json: is nested deeper");
  expect_no_scene(std::string(100000, '{'), "bad.json: line 1, column 2");
  expect_no_scene(std::string((1U << 20U) + 1, '['), "bad.json: has 1048577 bytes");
  std::filesystem::create_directory(path("folder.json"));
  expect_refused({"render", path("folder.json"), "-o", path("{view}.png")}, "is a directory");
  expect_refused({"render", path("missing.json"), "-o", path("{view}.png")}, "missing.json");
}

TEST_F(SceneCommand, FilesOfASceneMustExist) {
  expect_no_scene(scene_of("missing.ply"), path("missing.ply") + ": there is no such file");
  expect_no_scene(scene_of("knot.relief", R"(, "env": "sky.hdr")"),
                  path("sky.hdr") + ": there is no such file");
  write("broken.relief", "no patches");
  expect_no_scene(scene_of("broken.relief"), "broken.relief");
  std::filesystem::create_directory(path("folder.relief"));
  expect_no_scene(scene_of("folder.relief"), "folder.relief");
  expect_no_scene(scene_of("bad.json"), "bad.json: models[0].file: expected");
  expect_no_scene(scene_of("/dev/zero"), "/dev/zero: is not a regular file");
}

TEST_F(SceneCommand, AnEyeInTheMiddleOfTheModelSeesNothing) {
  std::string points;  // of a square about (2, 2, 0)
  for (int i = 0; i < 25; ++i)
    points += std::to_string(i % 5) + " " + std::to_string(i / 5) + " 0\n";
  const std::string square = write("square.xyz", points);
  expect_refused({"render", square, "-o", path("out.png"), "--eye", "2,2,0"}, "middle");
  expect_no_scene(
      R"({"models": [{"file": "square.xyz"}], "views": [{"name": "a", "eye": [2, 2, 0]}]})",
      "bad.json: view a: the eye is in the middle of the model");
}

}  // namespace
}  // namespace relief::test
