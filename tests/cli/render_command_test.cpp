// The command line that stands for an image makes the same image, to the byte.
#include "loader/command/render_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "loader/command/command_words.h"
#include "loader/load_scene.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "renderer/render.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

class CommandLine : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    file_ = path("the knot's.relief");
    ASSERT_EQ(run_relief({"convert", write_knot(1500), "-o", file_}).exit_code, 0);
    SceneSettings small;
    small.size = ImageSize{80, 60};
    load(file_, small);
  }
  void load(const std::string& file, const SceneSettings& settings,
            const LoadOptions& options = {}) {
    image_.load = options;
    auto plan = plan_scene(file, settings);
    ASSERT_TRUE(plan) << plan.error().message;
    // What the plan has of the image's size is not on the command line.
    plan_ = *plan_scene(file, {});
    Progress silent;
    auto scene = load_scene(*plan, options, silent);
    ASSERT_TRUE(scene) << scene.error().message;
    scene_ = std::move(*scene);
    auto views = render_settings_of(*plan, scene_.patches);
    ASSERT_TRUE(views) << views.error().message;
    view_ = views->front();
    complete_look(plan->views.front(), scene_, view_);
  }
  [[nodiscard]] RenderCommand command() const {
    CommandedImage image = image_;
    image.output = path("made.png");
    auto made = render_command(plan_, scene_, view_, image);
    if (made) return *made;
    ADD_FAILURE() << made.error().message;
    return {};
  }
  /// The options of the command behind the output.
  [[nodiscard]] std::string options() const {
    const std::string line = command().line;
    const std::string begin =
        "relief render " + shell_word(file_) + " -o " + shell_word(path("made.png"));
    EXPECT_EQ(line.substr(0, begin.size()), begin);
    return line.substr(std::min(begin.size() + 1, line.size()));
  }
  /// Runs the command by a shell, and renders the settings.
  void expect_same(const std::string& what) const {
    const RenderCommand made = command();
    EXPECT_TRUE(made.missing.empty()) << what << ": " << made.missing.front();
    const std::string line =
        shell_word(RELIEF_PROGRAM) + made.line.substr(sizeof "relief" - 1) + " >/dev/null";
    ASSERT_EQ(std::system(line.c_str()), 0) << what << ": " << line;  // NOLINT: as a user does
    Progress silent;
    const auto rendered = render(scene_.forms(), view_, silent);
    ASSERT_TRUE(rendered) << what << ": " << rendered.error().message;
    ASSERT_TRUE(write_png(path("own.png"), rendered->image));
    EXPECT_EQ(file_bytes(path("made.png")), file_bytes(path("own.png")))
        << what << ": " << made.line;
  }

  std::string file_;
  ScenePlan plan_;
  LoadedScene scene_;
  RenderSettings view_;
  CommandedImage image_;
};

TEST_F(CommandLine, HasOnlyWhatDiffers) {
  EXPECT_EQ(options(), "--size 80x60");
  view_.width = 1280;
  view_.height = 1024;
  EXPECT_NE(options().find("--eye"), std::string::npos) << "it was framed for another image";
  view_.camera = {{0.1, -9.0, 1e-7}, {0, 0, 0.25}, {0, 0, 1}, 45.0};
  EXPECT_EQ(options(), "--eye 0.1,-9,1e-07 --target 0,0,0.25");
  view_.camera.up = {0, 0, -1};
  view_.camera.vertical_fov_degrees = 1.0 / 3.0;
  EXPECT_EQ(options(), "--eye 0.1,-9,1e-07 --target 0,0,0.25 --up -z --fov 0.3333333333333333");
  view_.camera.orthographic_height = 2.5;
  EXPECT_EQ(options(), "--eye 0.1,-9,1e-07 --target 0,0,0.25 --up -z --orthographic 2.5");
}

TEST_F(CommandLine, MakesTheSameImageOfAnyView) {
  expect_same("as it is first seen");
  view_.camera = {
      {-3.1, -6.7, 2.3}, {0.1, 0.2, -0.3}, glm::normalize(glm::dvec3(0.3, 0.2, 0.9)), 37.7};
  expect_same("camera");
  view_.camera.orthographic_height = 4.7;
  expect_same("orthographic");
  view_.samples = 1;
  expect_same("one sample");
  view_.samples = 9;
  view_.primitive = Primitive::Quad;
  expect_same("quads");
  view_.interpolation = Interpolation::Direct;
  view_.cull = CullMode::None;
  expect_same("direct");
  view_.primitive = Primitive::Cell;
  view_.pixels_per_sample = 0.0;
  expect_same("finest level");
}

TEST_F(CommandLine, MakesTheSameImageOfAnyMaterialAndLight) {
  view_.camera.eye += glm::dvec3(0.1, 0.2, 0.3);
  view_.material = Material::Mirror;
  view_.constants.roughness = 0.3F;
  expect_same("mirror");
  view_.material = Material::Glass;
  view_.constants.roughness = 0.0F;
  view_.constants.ior = 1.33F;
  view_.constants.absorption = {0.1F, 0.2F, 1.0F / 3.0F};
  view_.constants.interfaces = 2;
  expect_same("glass");
  view_.material = Material::Split;
  view_.constants = {};
  expect_same("split");
  view_.material = Material::Lit;
  view_.constants.opacity = 0.7F;
  expect_same("lit");
  view_.lights.list = {
      {LightKind::Directional, glm::normalize(glm::dvec3(1, -2, 3)), {1, 0.5, 0}},
      {LightKind::Point, {0.3, -5.0, 1.0}, {20.0F, 10.0F, 1.0F / 3.0F}},
      {LightKind::Directional, glm::normalize(glm::dvec3(-1, -2, 0.1)), {0, 0, 1}}};
  view_.lights.ambient = {0.01F, 0.02F, 0.03F};
  expect_same("lights");
  view_.eye_dome = 0.8;
  expect_same("eye-dome lighting");
  view_.background = glm::vec3(linear_from_srgb8(glm::u8vec3(1, 200, 77)));
  expect_same("background");
  view_.background = glm::vec3(linear_from_srgb(0.123456F), 0.0F, 1.0F);
  expect_same("background that is no byte");
  view_.background.reset();
  expect_same("no background");
}

TEST_F(CommandLine, MakesTheSameImageInAnEnvironment) {
  Image sky{8, 4, {}};
  for (const char* name : {"R", "G", "B"}) {
    Channel channel{name, ChannelType::Float, {}};
    for (int k = 0; k < 32; ++k)
      channel.values.push_back(0.1F + 0.02F * static_cast<float>(k * (name[0] % 5)));
    sky.channels.push_back(channel);
  }
  const std::string env = path("sky & sea.exr");
  ASSERT_TRUE(write_exr(env, sky));
  SceneSettings settings;
  settings.environment = env;
  settings.material = Material::Lit;
  settings.size = ImageSize{80, 60};
  load(file_, settings);
  expect_same("lit by an environment");
  view_.lights.list = {{LightKind::Directional, {0, 0, 1}, {1, 0.5, 0}}};
  expect_same("and a light");
  view_.shows_environment = false;
  view_.background = glm::vec3(linear_from_srgb8(glm::u8vec3(9, 8, 7)));
  expect_same("that is not seen");
  view_.material = Material::Mirror;
  view_.constants = {};
  expect_same("and is reflected");
  view_.environment_rotation_degrees = 77.5;
  expect_same("and is turned");
}

TEST_F(CommandLine, MakesTheSameImageByOtherEngines) {
  for (const char* engine : {"multipass", "ewa", "raytrace"}) {
    SceneSettings settings;
    settings.engine = engine;
    settings.size = ImageSize{48, 36};
    load(file_, settings);
    view_.camera.eye *= 1.1;
    view_.material = Material::Lit;
    view_.multipass.radius_factor = 1.5;
    view_.ewa.cutoff = 1.7;
    view_.raytrace.samples = 3;
    expect_same(engine);
  }
}

TEST_F(CommandLine, MakesTheSameImageColouredByAScalar) {
  SceneSettings settings;
  settings.size = ImageSize{80, 60};
  LoadOptions options;
  options.colour_by = ColourBy{"height", ColourMap::Turbo, ColourRange{{-1.5, false}, {90, true}}};
  load(file_, settings, options);
  image_.has_legend = false;
  expect_same("height");
  EXPECT_NE(command().line.find("--colour-by height --colour-map turbo --colour-range -1.5,90%"),
            std::string::npos);
  // As a viewer holds its camera: at a right angle. --up would be that of the heights, too.
  view_.camera.eye += glm::dvec3(0.0, 0.0, 3.0);
  const glm::dvec3 line = glm::normalize(view_.camera.target - view_.camera.eye);
  view_.camera.up =
      glm::normalize(glm::dvec3(0, 0, 1) - glm::dot(line, glm::dvec3(0, 0, 1)) * line);
  expect_same("from above");
  view_.camera.up = glm::normalize(glm::dvec3(0.2, 0, 1));
  ASSERT_EQ(command().missing.size(), 1U);
  EXPECT_EQ(command().missing[0],
            "the camera: its up direction is not the model's, which --colour-by height is along");
}

TEST_F(CommandLine, ReadsScansAsTheyWereRead) {
  image_.load.read.format = "laz";
  image_.load.read.selection.classes.set(2).set(6);
  image_.load.read.selection.returns = ReturnChoice::Last;
  image_.load.read.selection.crop = Bounds{{-1, 0, 0.5}, {1e6, 2, 3}};
  image_.load.textures.flips_v = true;
  image_.load.textures.left_out = true;
  image_.exposure = -0.5;
  EXPECT_EQ(options(),
            "--size 80x60 --exposure -0.5 --texture none --flip-v --format laz --classes 2,6 "
            "--returns last --crop -1,0,1000000,2,0.5,3");
}

TEST_F(CommandLine, OverridesWhatASceneSays) {
  write("scene.json", R"({"models": [{"file": "the knot's.relief"}], "size": [80, 60], "roll": 10,
    "zoom": 2, "orthographic": "fit", "material": "mirror", "roughness": 0.5, "samples": 9,
    "primitive": "quad", "background": [1, 0, 0], "exposure": 1, "views": [{"name": "a"}]})");
  file_ = path("scene.json");
  load(file_, {});
  image_.exposure = 0.0;
  expect_same("the scene");
  view_.camera = {{0, -9, 3}, {0, 0, 0}, {0, 0, 1}, 50.0};
  view_.primitive = Primitive::Cell;
  view_.samples = 4;
  view_.constants.roughness = 0.0F;
  expect_same("a camera");
  view_.material = Material::Unlit;
  view_.background.reset();
  expect_same("another look");
}

TEST_F(CommandLine, SaysWhatItCannotSay) {
  view_.background = glm::vec3(1.5F);
  ASSERT_EQ(command().missing.size(), 1U);
  EXPECT_EQ(command().missing[0], "the background: no sRGB colour has just this light");
  write("scene.json", R"({"models": [{"file": "the knot's.relief"}], "material": "lit",
    "lights": [{"direction": [1, 0, 0]}], "views": [{"name": "a"}, {"name": "b"}]})");
  file_ = path("scene.json");
  load(file_, {});
  view_.lights.list.clear();
  ASSERT_EQ(command().missing.size(), 2U);
  EXPECT_EQ(command().missing[0],
            "the lights: --light adds some, but none take away those of a scene");
  EXPECT_EQ(command().missing[1], "the view: the command makes all views of the scene");
}

TEST(ShellWord, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_word("a/b-c_1.relief"), "a/b-c_1.relief");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("my scan.ply"), "'my scan.ply'");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_word("{view}.png"), "'{view}.png'");
  EXPECT_EQ(shell_word("Zürich"), "'Zürich'");
}

}  // namespace
}  // namespace relief::test
