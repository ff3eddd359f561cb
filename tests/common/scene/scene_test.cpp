// Every key of a scene file, and every sentence about one that is wrong.
#include "common/scene/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

/// Engines and options that no library has: scene files know those that they are given.
EngineKeys made_up_engines() {
  return {{"dots", "lines"},
          {{.key = "shape", .kind = OptionKind::Choice, .choices = {"round", "square"}},
           {.key = "dot-size", .kind = OptionKind::Number, .range = {1.0, 4.0}},
           {.key = "passes", .kind = OptionKind::Integer, .range = {1.0, 64.0}}}};
}

class Scenes : public testing::Test {
 protected:
  Result<Scene> read(const std::string& text) {
    test::spill(folder_ / "scene.json", text);
    return read_scene(folder_ / "scene.json", made_up_engines());
  }
  Scene must_read(const std::string& text) {
    const auto scene = read(text);
    if (scene) return *scene;
    ADD_FAILURE() << scene.error().message;
    return {{{}}, {}, {{}}};
  }
  /// What is said about a scene, after the file's name.
  std::string complaint(const std::string& text) {
    const auto scene = read(text);
    if (scene) return "nothing";
    const std::string name = (folder_ / "scene.json").string() + ": ";
    EXPECT_EQ(scene.error().message.rfind(name, 0), 0U) << scene.error().message;
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
    return scene.error().message.substr(name.size());
  }
  /// The same about a scene that has these members beside a model and a view.
  std::string about_settings(const std::string& members) {
    return complaint(R"({"models": [{"file": "a.ply"}], "views": [{"name": "v"}], )" + members +
                     "}");
  }
  std::string about_model(const std::string& model) {
    return complaint(R"({"models": [)" + model + R"(], "views": [{"name": "v"}]})");
  }
  std::string about_views(const std::string& views) {
    return complaint(R"({"models": [{"file": "a.ply"}], "views": )" + views + "}");
  }

  test::ScratchFolder folder_;
};

void expect_starts(const std::string& text, const std::string& start) {
  EXPECT_EQ(text.rfind(start, 0), 0U) << text << "\n  does not start with\n" << start;
}

TEST_F(Scenes, EveryKeyIsRead) {
  const Scene scene = must_read(R"({
    "models": [
      {"file": "a.relief", "closed": true, "material": "glass", "ior": 2, "absorption": [0, 1, 2], "opacity": 0.5,
       "interfaces": 2},
      {"file": "/b.ply", "transform": {"translation": [1, -2.5, 3e2],
                                       "rotation": {"axis": [0, 0, 2], "degrees": 90}, "scale": 2}}
    ],
    "size": [640, 480], "fov": 30, "engine": "lines", "shape": "square", "dot-size": 1.5, "passes": 3, "material": "mirror", "env": "sky.hdr", "env_rotation": -30,
    "lights": [{"direction": [0, 3, 4]},
               {"position": [1, 2, 3], "colour": [1, 0.5, 0], "intensity": 8}], "ambient": [0, 0.5, 2],
    "ior": 1.25, "absorption": [1, 0, 100], "roughness": 0.5, "interfaces": 1, "exposure": -1.5,
    "background": [1, 0.5, 0], "outputs": ["normal", "patch", "colour"], "orbit": [30, -20],
    "views": [
      {"name": "front-1.0_A"},
      {"name": "top", "orthographic": "fit", "orbit": [0, 90, 1.5], "background": "none", "outputs": "all"},
      {"name": "near", "orthographic": 0.25, "eye": [1, 2, 3], "target": [0, 0, 0], "up": [0, 0, 2], "material": "unlit",
       "size": [1, 32768], "outputs": ["depth", "uv"]}
    ]})");
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_EQ(scene.models[0].file, folder_ / "a.relief");
  EXPECT_EQ(scene.models[0].transform.scale, 1.0);
  EXPECT_EQ(scene.models[0].transform.rotation, glm::dmat3(1.0));
  EXPECT_EQ(scene.models[0].material,
            (MaterialOverrides{Material::Glass, 2.0, glm::vec3(0, 1, 2), std::nullopt, 0.5, 2}));
  EXPECT_EQ(scene.models[1].material, MaterialOverrides{});
  EXPECT_EQ(scene.models[0].is_closed, true);
  EXPECT_FALSE(scene.models[1].is_closed);
  EXPECT_EQ(scene.models[1].file, "/b.ply");
  EXPECT_EQ(scene.models[1].transform.translation, glm::dvec3(1, -2.5, 300));
  EXPECT_EQ(scene.models[1].transform.rotation, rotation_about({0, 0, 1}, 90));
  EXPECT_EQ(scene.models[1].transform.scale, 2.0);

  const SceneSettings& all = scene.settings;
  EXPECT_EQ(all.size->width, 640U);
  EXPECT_EQ(all.size->height, 480U);
  EXPECT_EQ(all.fov_degrees, 30.0);
  EXPECT_EQ(all.engine, "lines");
  EXPECT_EQ(all.options, (OptionValues{{"shape", "square"}, {"dot-size", 1.5}, {"passes", 3.0}}));
  EXPECT_EQ(all.material, Material::Mirror);
  EXPECT_EQ(all.ior, 1.25);
  EXPECT_EQ(all.absorption, glm::vec3(1, 0, 100));
  EXPECT_EQ(all.roughness, 0.5);
  EXPECT_EQ(all.interfaces, 1);
  EXPECT_EQ(all.exposure, -1.5);
  EXPECT_EQ(all.environment, folder_ / "sky.hdr");
  EXPECT_EQ(all.environment_rotation_degrees, -30.0);
  ASSERT_EQ(all.lights->size(), 2U);
  EXPECT_EQ((*all.lights)[0].kind, LightKind::Directional);
  EXPECT_LT(glm::distance((*all.lights)[0].position, glm::dvec3(0, 0.6, 0.8)), 1e-15);
  EXPECT_EQ((*all.lights)[0].colour, glm::vec3(1));
  EXPECT_EQ((*all.lights)[1].kind, LightKind::Point);
  EXPECT_EQ((*all.lights)[1].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ((*all.lights)[1].colour, glm::vec3(8, 4, 0));
  EXPECT_EQ(*all.ambient, glm::vec3(0, 0.5, 2));
  EXPECT_EQ(*all.background->colour, glm::vec3(1, linear_from_srgb(0.5F), 0));
  EXPECT_TRUE(all.outputs->normal && all.outputs->patch_id);
  EXPECT_FALSE(all.outputs->depth || all.outputs->uv);
  EXPECT_EQ(all.orbit->azimuth_degrees, 30.0);
  EXPECT_EQ(all.orbit->elevation_degrees, -20.0);
  EXPECT_EQ(all.orbit->distance_in_radii, 0.0);

  ASSERT_EQ(scene.views.size(), 3U);
  EXPECT_EQ(scene.views[0].name, "front-1.0_A");
  EXPECT_FALSE(scene.views[0].settings.orbit || scene.views[0].settings.size);
  EXPECT_EQ(scene.views[1].settings.orbit->distance_in_radii, 1.5);
  EXPECT_FALSE(scene.views[1].settings.background->colour);
  EXPECT_TRUE(scene.views[1].settings.outputs->uv);
  EXPECT_EQ(scene.views[2].settings.eye, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.views[2].settings.target, glm::dvec3(0, 0, 0));
  EXPECT_EQ(scene.views[2].settings.up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.views[2].settings.material, Material::Unlit);
  EXPECT_EQ(scene.views[2].settings.size->height, 32768U);
  EXPECT_TRUE(scene.views[2].settings.outputs->depth && scene.views[2].settings.outputs->uv);
  EXPECT_FALSE(scene.views[2].settings.outputs->normal);
  EXPECT_FALSE(all.orthographic);
  ASSERT_TRUE(scene.views[1].settings.orthographic && scene.views[2].settings.orthographic);
  EXPECT_FALSE(scene.views[1].settings.orthographic->height);
  EXPECT_EQ(scene.views[2].settings.orthographic->height, 0.25);
}

TEST_F(Scenes, SettingsThatAreWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"("colour": 1)", "does not know the key \"colour\"; expected models, views, size, orbit"},
      {R"("size": 640)", "size: expected [width, height], whole numbers"},
      {R"("size": [640, 480, 1])", "size: expected [width, height]"},
      {R"("size": [640, 0])", "size[1]: expected a number from 1 to 32768; found 0"},
      {R"("size": [32769, 1])", "size[0]: expected a number from 1 to 32768; found 32769"},
      {R"("size": [640.5, 1])", "size: expected [width, height], whole numbers"},
      {R"("orbit": "30,20")", "orbit: expected [azimuth, elevation] or"},
      {R"("orbit": [30])", "orbit: expected [azimuth, elevation] or"},
      {R"("orbit": [30, 20, 0])", "orbit: expected [azimuth, elevation] or"},
      {R"("orbit": [30, null])", "orbit[1]: expected a number from -1e+06 to 1e+06; found null"},
      {R"("orbit": [0, 0], "eye": [1, 0, 0])", "expected either an orbit or eye and target"},
      {R"("orbit": [0, 0], "target": [1, 0, 0])", "expected either an orbit or eye and target"},
      {R"("orbit": [0, 0], "view": "top")", "expected either an orbit or a view"},
      {R"("view": "above")", "view: expected front, back, left, right, top, bottom, iso"},
      {R"("up": "w")", "up: expected x, y, z, -x, -y, -z"},
      {R"("zoom": 0)", "zoom: expected a number from 0.01 to 10000; found 0"},
      {R"("eye": [1, 2])", "eye: expected [x, y, z], three numbers; found a list"},
      {R"("eye": [1, 2, 1e13])", "eye[2]: expected a number from -1e+12 to 1e+12; found 1"},
      {R"("eye": [1, 2, 3], "target": [1, 2, 3])", "views[0]: the eye is where its target is"},
      {R"("eye": [1, 2, 3], "up": [0, 0, 0])", "up: expected [x, y, z] longer than 0"},
      {R"("fov": 180)", "fov: expected degrees from 0.01 to 175; found 180"},
      {R"("fov": "45")", "fov: expected degrees from 0.01 to 175; found \"45\""},
      {R"("orthographic": 0)",
       "orthographic: expected the image's height in world units, above "
       "0, or \"fit\"; found 0"},
      {R"("orthographic": -2)", "orthographic: expected the image's height in world units, above"},
      {R"("orthographic": "wide")", "orthographic: expected the image's height in world units"},
      {R"("orthographic": [1])", "orthographic: expected the image's height in world units"},
      {R"("orthographic": null)", "orthographic: expected the image's height in world units"},
      {R"("orthographic": true)", "orthographic: expected the image's height in world units"},
      {R"("orthographic": 1, "fov": 45)", "expected either fov or orthographic; found both"},
      {R"("engine": "embree")", "engine: expected dots, lines; found \"embree\""},
      {R"("engine": 1)", "engine: expected dots, lines; found 1"},
      {R"("primitive": "cell")",
       "does not know the key \"primitive\"; expected models, views, size"},
      {R"("shape": "oval")", "shape: expected round, square; found \"oval\""},
      {R"("shape": 1)", "shape: expected round, square; found 1"},
      {R"("dot-size": 0.5)", "dot-size: expected a number from 1 to 4; found 0.5"},
      {R"("dot-size": "2")", "dot-size: expected a number from 1 to 4; found \"2\""},
      {R"("dot-size": [2])", "dot-size: expected a number from 1 to 4; found a list"},
      {R"("passes": 1.5)", "passes: expected a whole number from 1 to 64; found 1.5"},
      {R"("material": "gold")",
       "material: expected unlit, lit, mirror, glass, split; found \"gold\""},
      {R"("ior": 0.9)", "ior: expected a number from 1 to 4; found 0.9"},
      {R"("ior": 4.1)", "ior: expected a number from 1 to 4; found 4.1"},
      {R"("opacity": 1.5)", "opacity: expected a number from 0 to 1; found 1.5"},
      {R"("interfaces": 3)", "interfaces: expected 1 or 2; found 3"},
      {R"("interfaces": 1.5)", "interfaces: expected 1 or 2; found 1.5"},
      {R"("interfaces": "2")", "interfaces: expected 1 or 2; found \"2\""},
      {R"("absorption": [0, 0])", "absorption: expected [r, g, b], linear, each from 0 to 100"},
      {R"("absorption": [0, 0, 101])", "absorption[2]: expected a number from 0 to 100; found 101"},
      {R"("roughness": -0.1)", "roughness: expected a number from 0 to 1; found -0.1"},
      {R"("exposure": 21)", "exposure: expected stops from -20 to 20; found 21"},
      {R"("lights": [])", "lights: expected a list of lights, at least one; found an empty list"},
      {R"("lights": {})", "lights: expected a list of lights, at least one; found an object"},
      {R"("lights": [{}])", "lights[0]: expected either a direction, toward the light, or a "},
      {R"("lights": [{"direction": [0, 0, 1], "position": [0, 0, 1]}])",
       "lights[0]: expected either a direction, toward the light, or a position; found both"},
      {R"("lights": [{"direction": [0, 0, 0]}])", "lights[0].direction: expected [x, y, z] longer"},
      {R"("lights": [{"position": [0, 0]}])", "lights[0].position: expected [x, y, z], three"},
      {R"("lights": [{"position": [0, 0, 1], "colour": [1, -0.1, 0]}])",
       "lights[0].colour[1]: expected a number from 0 to 1; found -0.1"},
      {R"("lights": [{"position": [0, 0, 1], "colour": "red"}])",
       "lights[0].colour: expected [r, g, b], linear, each from 0 to 1; found \"red\""},
      {R"("lights": [{"direction": [0, 0, 1], "intensity": 1001}])",
       "lights[0].intensity: expected a number from 0 to 1000; found 1001"},
      {R"("lights": [{"position": [0, 0, 1], "intensity": -1}])",
       "lights[0].intensity: expected a number from 0 to 1e+12; found -1"},
      {R"("lights": [{"direction": [0, 0, 1], "shadow": 1}])",
       "lights[0]: does not know the key \"shadow\"; expected direction, position, colour, "},
      {R"("ambient": [0, 0, -1])", "ambient[2]: expected a number from 0 to 1000; found -1"},
      {R"("ambient": 1)", "ambient: expected [r, g, b], linear, each from 0 to 1000; found 1"},
      {R"("env": "")", "env: expected the name of an environment map"},
      {R"("env": "a\u0000b")", "env: expected the name of an environment map"},
      {R"("background": "black")", "background: expected [r, g, b], sRGB values from 0 to 1, or "},
      {R"("background": [0, 0, 255])", "background[2]: expected a number from 0 to 1; found 255"},
      {R"("outputs": "normal")", "outputs: expected a list of some of colour, normal"},
      {R"("outputs": [])", "outputs: expected a list of some of colour, normal"},
      {R"("outputs": ["smell"])", "outputs: expected a list of some of colour, normal"}};
  for (const auto& [members, start] : cases) expect_starts(about_settings(members), start);
}

TEST_F(Scenes, HaveAtMostSixteenLights) {
  std::string lights = R"({"direction": [0, 0, 1]})";
  for (std::size_t i = 1; i < kMaxLights; ++i) lights += R"(, {"position": [0, 0, 1]})";
  EXPECT_EQ(about_settings("\"lights\": [" + lights + "]"), "nothing");
  EXPECT_EQ(about_settings("\"lights\": [" + lights + ", {}]"),
            "lights: has 17 lights; at most 16 are read");
}

TEST_F(Scenes, ModelsThatAreWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "models: expected a list of models, at least one; found an empty list"},
      {"3", "models[0]: expected an object with file, transform, closed, raw, material, ior"},
      {"{}", "models[0].file: is missing; expected the name of a patch file"},
      {R"({"file": 1})", "models[0].file: expected the name of a patch file"},
      {R"({"file": ""})", "models[0].file: expected the name of a patch file"},
      {R"({"file": "a\u0000.ply"})", "models[0].file: expected the name of a patch file"},
      {R"({"file": "other.json"})",
       "models[0].file: expected the name of a patch file, a scan, a mesh or a volume, not another "
       "scene"},
      {R"({"file": "a.ply", "material": "gold"})",
       "models[0].material: expected unlit, lit, mirror, glass, split; found \"gold\""},
      {R"({"file": "a.ply", "ior": "1.5"})", "models[0].ior: expected a number from 1 to 4; found"},
      {R"({"file": "a.ply", "absorption": [0, -1, 0]})",
       "models[0].absorption[1]: expected a number from 0 to 100; found -1"},
      {R"({"file": "a.ply", "roughness": 2})",
       "models[0].roughness: expected a number from 0 to 1"},
      {R"({"file": "a.ply", "scale": 2})", "models[0]: does not know the key \"scale\""},
      {R"({"file": "a.ply"}, {"file": "b.ply", "transform": {"scale": 0}})",
       "models[1].transform.scale: expected a number from 1e-9 to 1e9; found 0"},
      {R"({"file": "a.ply", "transform": {"scale": -1}})", "models[0].transform.scale: expected"},
      {R"({"file": "a.ply", "transform": {"scale": [1, 1, 2]}})",
       "models[0].transform.scale: expected a number"},
      {R"({"file": "a.ply", "transform": []})", "models[0].transform: expected an object with"},
      {R"({"file": "a.ply", "transform": {"translation": [0, "1", 0]}})",
       "models[0].transform.translation[1]: expected a number"},
      {R"({"file": "a.ply", "transform": {"rotation": [0, 0, 0, 1]}})",
       "models[0].transform.rotation: expected an object with axis, degrees; found a list"},
      {R"({"file": "a.ply", "transform": {"rotation": {"degrees": 9}}})",
       "models[0].transform.rotation.axis: is missing"},
      {R"({"file": "a.ply", "transform": {"rotation": {"axis": [0, 0, 1]}}})",
       "models[0].transform.rotation.degrees: is missing"},
      {R"({"file": "a.ply", "transform": {"rotation": {"axis": [0, 0, 0], "degrees": 9}}})",
       "models[0].transform.rotation.axis: expected [x, y, z] longer than 0"}};
  for (const auto& [models, start] : cases) expect_starts(about_model(models), start);
  expect_starts(complaint(R"({"views": [{"name": "v"}]})"), "models: is missing; expected a list");
}

TEST_F(Scenes, ViewsThatAreWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"[]", "views: expected a list of views, at least one; found an empty list"},
      {"{}", "views: expected a list of views, at least one; found an object"},
      {"[[]]", "views[0]: expected an object with name, size, orbit"},
      {"[{}]", "views[0].name: is missing; expected a name"},
      {R"([{"name": 1}])", "views[0].name: expected a name of at most 100 letters"},
      {R"([{"name": "a"}, {"name": "b"}, {"name": "a"}])",
       "views[2].name: another view has the name a, too; rename one"},
      {R"([{"name": "a", "models": []}])", "views[0]: does not know the key \"models\""},
      {R"([{"name": "a"}, {"name": "b", "orbit": 5}])", "views[1].orbit: expected [azimuth"},
      {R"([{"name": "a", "target": [0, 0, 0]}])",
       "views[0]: has a target or up, which need an eye"},
      {R"([{"name": "a", "up": [0, 0, 1]}])", "views[0]: has a target or up, which need an eye"}};
  for (const auto& [views, start] : cases) expect_starts(about_views(views), start);
  for (const std::string name :
       {"", ".", "..", ".hidden", "a/b", "a\\\\b", "a b", "\\u00e4", "a\\n", "a\\u0000"}) {
    expect_starts(about_views(R"([{"name": ")" + name + "\"}]"),
                  "views[0].name: expected a name of at most 100 letters");
  }
  expect_starts(about_views(R"([{"name": ")" + std::string(101, 'a') + "\"}]"),
                "views[0].name: expected a name of at most 100 letters");
  expect_starts(complaint(R"({"models": [{"file": "a.ply"}]})"), "views: is missing");
}

TEST_F(Scenes, WhatIsNoJsonIsToldByLineAndColumn) {
  expect_starts(complaint("{\n  \"models\": [1,\n  ]\n}"), "line 3, column 3: is no JSON: ");
  expect_starts(complaint("not json"), "line 1, column 2: is no JSON: ");
  expect_starts(complaint("{\"size\": [1e999, 1]}"), "line 1, column 15: is no JSON: number over");
  expect_starts(complaint("{\"size\": [NaN, 1]}"), "line 1, column 11: is no JSON: ");
  expect_starts(complaint("{} {}"), "line 1, column 4: is no JSON: ");
  expect_starts(complaint("{\"a\xff\": 1}"), "line 1, column 4: is no JSON: ");
  expect_starts(complaint("[]"), "expected an object with models, views");
}

TEST_F(Scenes, EveryTruncationIsRefused) {
  const std::string text = R"({"models": [{"file": "a.ply"}], "views": [{"name": "v"}]})";
  EXPECT_EQ(complaint(text), "nothing");
  for (std::size_t size = 1; size < text.size(); ++size)
    expect_starts(complaint(text.substr(0, size)), "line 1, column ");
  EXPECT_EQ(complaint(""), "the file is empty");
}

TEST_F(Scenes, HostileFilesAreRefusedEarly) {
  EXPECT_EQ(complaint(std::string(500000, '[')), "is nested deeper than 16 levels");
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_EQ(complaint(objects), "is nested deeper than 16 levels");
  expect_starts(complaint(R"({"models": [{"file": "a", "file": "b"}]})"),
                "an object has the key \"file\" twice");
  expect_starts(complaint(std::string((1U << 20U) + 1, ' ')),
                "has 1048577 bytes; a scene file has at most 1048576");
  std::string views = R"([{"name": "v"})";
  for (std::size_t i = 0; i < kMaxSceneViews; ++i)
    views += ",{\"name\":\"" + std::to_string(i) + "\"}";
  expect_starts(about_views(views + "]"), "views: has 10001 views; at most 10000 are read");
  std::string models = "{}";
  for (std::size_t i = 0; i < kMaxSceneModels; ++i) models += ",{}";
  expect_starts(about_model(models), "models: has 1001 models; at most 1000 are read");
  // What a sentence shows of the file is short, and nothing in it reaches a terminal as it is.
  const std::string shown =
      about_settings(R"("material": "\u001b[2J)" + std::string(9999, 'x') + "\"");
  EXPECT_LT(shown.size(), 150U);
  EXPECT_EQ(shown.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace relief
