// Scenes with volumes and 3D Gaussians among patches.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "common/patch_file/patch_file.h"
#include "loader/load_scene.h"
#include "loader/models/load_volume.h"
#include "loader/scene/view_settings.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/gaussians/gaussian_files.h"

namespace relief {
namespace {

/// 4 x 4 x 4 nodes from 0 to 3.
std::string nrrd() {
  std::string text = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: ascii\n\n";
  for (int k = 0; k < 64; ++k) text += fmt::format("{} ", k);
  return text;
}

class VolumeScenes : public testing::Test {
 protected:
  void SetUp() override {
    test::spill(folder_ / "a.nrrd", nrrd());
    test::spill(folder_ / "b.vox", std::string(64, '\7'));
    test::spill(folder_ / "c.ply", test::plain_ply(test::sample_scene(0), "ascii"));
    test::spill(folder_ / "square.off",
                "OFF\n4 2 0\n0 0 -1\n3 0 -1\n3 3 -1\n0 3 -1\n3 0 1 2\n3 0 2 3\n");
  }
  std::filesystem::path scene(const std::string& models, const std::string& more = "") {
    const auto file = folder_ / "scene.json";
    test::spill(file, "{\"models\": [" + models + "], \"views\": [{\"name\": \"v\"" + more + "}]}");
    return file;
  }
  Result<ScenePlan> plan(const std::filesystem::path& file, const SceneSettings& overrides = {}) {
    RELIEF_TRY_ASSIGN(auto made, plan_scene(file, overrides));
    choose_volume_engine(made, {});
    return made;
  }
  std::string error_of(const std::string& models, const std::string& more = "",
                       const LoadOptions& options = {}) {
    const auto made = plan(scene(models, more));
    if (!made) return made.error().message;
    Progress silent;
    const auto loaded = load_scene(*made, options, silent);
    return loaded ? "no error" : loaded.error().message;
  }
  void expect_error(const std::string& part, const std::string& models,
                    const std::string& more = "", const LoadOptions& options = {}) {
    const std::string error = error_of(models, more, options);
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << "one sentence: " << error;
  }

  test::ScratchFolder folder_;
};

TEST_F(VolumeScenes, AllKindsAreInOneScene) {
  const auto made = plan(scene(R"({"file": "a.nrrd", "transfer": "mr", "iso": 20},
    {"file": "square.off", "transform": {"translation": [0, 0, -9]}},
    {"file": "a.nrrd", "transform": {"translation": [10, 0, 0]}, "material": "unlit"},
    {"file": "b.vox", "raw": "4x4x4:u8"}, {"file": "c.ply"})"));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->views[0].settings.engine, kVolumeEngine);
  Progress silent;
  const auto loaded = load_scene(*made, {}, silent);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_TRUE(loaded->volumes && !loaded->volume && !loaded->gaussians);
  const std::vector<VolumePart>& parts = loaded->volumes->list;
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_TRUE(std::holds_alternative<ScalarVolume>(parts[2].what));
  EXPECT_TRUE(std::holds_alternative<GaussianCloud>(parts[3].what));
  EXPECT_EQ(parts[1].settings, 2U);
  EXPECT_EQ(parts[1].material, 1U);
  EXPECT_FALSE(loaded->patches.patches.empty()) << "onepass draws the surface";
  // Cameras see the moved volume to the right and the square behind.
  EXPECT_EQ(loaded->patches.bounds.max.x, 13.0);
  EXPECT_EQ(loaded->patches.bounds.min.z, -10.0);
  const auto settings = render_settings_of(*made, loaded->patches);
  ASSERT_TRUE(settings) << settings.error().message;
  ASSERT_EQ(settings->front().volumes.size(), 5U) << "one for each model";
  EXPECT_EQ(settings->front().volumes[0].transfer, "mr");
  EXPECT_EQ(settings->front().volumes[0].iso, 20.0);
  EXPECT_EQ(settings->front().volumes[2].transfer, "auto");
}

TEST_F(VolumeScenes, TheCommandLineGoesBeforeAModelBeforeAView) {
  const auto file =
      scene(R"({"file": "a.nrrd", "transfer": "mr"}, {"file": "c.ply"})", R"(, "iso": 7)");
  SceneSettings overrides;
  overrides.options["iso"] = 9.0;
  const auto made = plan(file, overrides);
  ASSERT_TRUE(made) << made.error().message;
  const auto settings = render_settings_of(*made, made->views[0], PatchModel());
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->volumes[0].iso, 9.0);
  EXPECT_EQ(settings->volumes[0].transfer, "mr");
  EXPECT_EQ(settings->volume.transfer, "auto");
}

TEST_F(VolumeScenes, TransferFilesAreRelativeToTheScene) {
  const auto made = plan(scene(R"({"file": "a.nrrd", "transfer": "mine.json"}, {"file": "c.ply"})",
                               R"(, "transfer": "views.json")"));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->views[0].settings.options.at("transfer"),
            OptionValue((folder_ / "views.json").string()));
  EXPECT_EQ(made->models[0].options.at("transfer"), OptionValue((folder_ / "mine.json").string()));
}

TEST_F(VolumeScenes, ASingleVolumeStaysOne) {
  const auto made = plan(scene(R"({"file": "a.nrrd", "transfer": "mr"})"));
  ASSERT_TRUE(made) << made.error().message;
  Progress silent;
  const auto loaded = load_scene(*made, {}, silent);
  ASSERT_TRUE(loaded && loaded->volume && !loaded->volumes);
  const auto settings = render_settings_of(*made, loaded->patches);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->front().volume.transfer, "mr");
}

TEST_F(VolumeScenes, WhatIsWrongIsSaid) {
  const std::string two = R"({"file": "a.nrrd"}, {"file": "square.off"})";
  expect_error("which engine onepass can't draw; choose engine volume", two,
               R"(, "engine": "onepass")");
  expect_error("engine volume-truth draws a single volume", two, R"(, "engine": "volume-truth")");
  expect_error("square.off: has iso, which is for volumes",
               R"({"file": "a.nrrd"}, {"file": "square.off", "iso": 3})");
  expect_error("models[0].iso: expected a number", R"({"file": "a.nrrd", "iso": "3"})");
  expect_error("models[0]: ", R"({"file": "a.nrrd", "visibility": "sorted"})");
  expect_error("raw: ", R"({"file": "b.vox", "raw": "4x4:u8"})");
  expect_error("two models read it with different layouts",
               R"({"file": "b.vox", "raw": "4x4x4:u8"}, {"file": "b.vox", "raw": "2x4x4:u16"})");
  LoadOptions options;
  options.volume.raw = *parse_raw_layout("4x4x4:u8");
  expect_error("--raw is for a single file", two, "", options);
}

}  // namespace
}  // namespace relief
