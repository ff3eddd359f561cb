// Volumes and 3D Gaussians from files: which files are some, which engine draws them, and where
// they stand.
#include "loader/models/load_volume.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "loader/load_scene.h"
#include "loader/scene/view_settings.h"
#include "models/knot_scan.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/gaussians/gaussian_files.h"

namespace relief {
namespace {

/// 3 x 4 x 5 nodes, 1 apart, whose values count up from 0.
std::string small_nrrd() {
  std::string text =
      "NRRD0004\ntype: float\ndimension: 3\nsizes: 3 4 5\nencoding: ascii\nspacings: 1 1 1\n\n";
  for (int n = 0; n < 60; ++n) text += fmt::format("{}\n", n);
  return text;
}

class LoadingVolumes : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    test::spill(folder_ / name.c_str(), bytes);
    return folder_ / name.c_str();
  }
  std::filesystem::path write_gaussians(const std::string& name, int degree) {
    return write(name, test::plain_ply(test::sample_scene(degree), "ascii"));
  }
  /// The plan for a file, as `relief render` makes it.
  static ScenePlan planned(const std::filesystem::path& file, const SceneSettings& settings = {}) {
    auto plan = plan_scene(file, settings);
    EXPECT_TRUE(plan) << plan.error().message;
    choose_volume_engine(*plan, {});
    return *std::move(plan);
  }
  LoadedScene must_load(const ScenePlan& plan) {
    auto scene = load_scene(plan, {}, silent_);
    if (scene) return *std::move(scene);
    ADD_FAILURE() << scene.error().message;
    return {};
  }
  std::string error_of(const ScenePlan& plan) {
    const auto scene = load_scene(plan, {}, silent_);
    return scene ? "no error" : scene.error().message;
  }

  test::ScratchFolder folder_;
  Progress silent_;
};

TEST_F(LoadingVolumes, FilesAreKnownByNameByHeaderOrByALayout) {
  const VolumeReadOptions none;
  EXPECT_TRUE(has_kernels("missing.nii.gz", none)) << "known by its name, whatever is in it";
  EXPECT_TRUE(has_kernels("missing.spz", none));
  EXPECT_FALSE(has_kernels("missing.ply", none)) << "a file that can't be read is neither";
  EXPECT_FALSE(has_kernels(write("knot.ply", knot_scan_ply(20)), none));
  EXPECT_TRUE(has_kernels(write_gaussians("scene.ply", 0), none));
  const auto bytes = write("voxels.bin", std::string(60, '\1'));
  EXPECT_FALSE(has_kernels(bytes, none));
  VolumeReadOptions raw;
  raw.raw = *parse_raw_layout("3x4x5:u8");
  EXPECT_TRUE(has_kernels(bytes, raw));
}

TEST_F(LoadingVolumes, AreDrawnByTheirEngineUnlessOneIsNamed) {
  for (const auto& file : {write("a.nrrd", small_nrrd()), write_gaussians("b.ply", 1)}) {
    EXPECT_EQ(planned(file).views.front().settings.engine, "volume");
    SceneSettings named;
    named.engine = "volume-truth";
    EXPECT_EQ(planned(file, named).views.front().settings.engine, "volume-truth");
  }
  EXPECT_FALSE(planned(write("knot.ply", knot_scan_ply(20))).views.front().settings.engine)
      << "scans keep the usual one";
}

TEST_F(LoadingVolumes, EachViewOfASceneHasItsEngine) {
  write("a.nrrd", small_nrrd());
  const ScenePlan plan = planned(write("scene.json", R"({"models": [{"file": "a.nrrd"}],
      "views": [{"name": "a"}, {"name": "b", "engine": "volume"}]})"));
  ASSERT_EQ(plan.views.size(), 2U);
  EXPECT_EQ(plan.views[0].settings.engine, "volume");
  EXPECT_EQ(plan.views[1].settings.engine, "volume");
  const LoadedScene scene = must_load(plan);
  ASSERT_TRUE(scene.volume);
  EXPECT_EQ(scene.volume->size, glm::uvec3(3, 4, 5));
}

TEST_F(LoadingVolumes, OtherEnginesSayWhichOnesDrawThem) {
  SceneSettings named;
  for (const char* const engine : {"onepass", "multipass", "ewa", "raytrace"}) {
    named.engine = engine;
    for (const auto& file : {write("a.nrrd", small_nrrd()), write_gaussians("b.ply", 0)}) {
      EXPECT_EQ(error_of(planned(file, named)),
                fmt::format("{}: is a volume or a scene of 3D Gaussians, which engine {} can't "
                            "draw; choose engine volume or volume-reference",
                            file.string(), engine));
    }
  }
}

TEST_F(LoadingVolumes, HaveTheirNodesAsTheExtentThatCamerasSee) {
  const LoadedScene scene = must_load(planned(write("a.nrrd", small_nrrd())));
  EXPECT_EQ(scene.patches.bounds.min, glm::dvec3(0.0));
  EXPECT_EQ(scene.patches.bounds.max, glm::dvec3(2.0, 3.0, 4.0));
  EXPECT_TRUE(scene.patches.patches.empty());
  EXPECT_EQ(scene.patches.stance, kZUp);
  EXPECT_FALSE(scene.gaussians || scene.mesh || scene.splats);
}

// Values of small_nrrd() are those of its nodes' indices: from 30 on only k is 2 or more.
TEST_F(LoadingVolumes, AreFramedByWhatTheirFunctionShows) {
  const auto file = write("a.nrrd", small_nrrd());
  SceneSettings settings;
  settings.options["transfer"] =
      write("f.json", R"({"colour": [[0, 1, 1, 1]], "opacity": [[29, 0], [30, 0.5]]})").string();
  const LoadedScene scene = must_load(planned(file, settings));
  ASSERT_FALSE(scene.patches.extremes.empty());
  for (const glm::dvec3& point : scene.patches.extremes) EXPECT_GE(point.z, 1.99);
  EXPECT_EQ(scene.patches.bounds.min, glm::dvec3(0.0)) << "the bounds are those of all nodes";
}

TEST_F(LoadingVolumes, StandWhereTheirSceneSays) {
  write("a.nrrd", small_nrrd());
  const LoadedScene scene = must_load(planned(write("scene.json", R"({"models": [{"file": "a.nrrd",
      "transform": {"translation": [10, 0, 0], "scale": 2}}], "views": [{"name": "a"}]})")));
  EXPECT_EQ(scene.patches.bounds.min, glm::dvec3(10.0, 0.0, 0.0));
  EXPECT_EQ(scene.patches.bounds.max, glm::dvec3(14.0, 6.0, 8.0));
  ASSERT_TRUE(scene.volume);
  EXPECT_EQ(std::get<RegularGrid>(scene.volume->placement).step[0], glm::dvec3(2.0, 0.0, 0.0));
}

TEST_F(LoadingVolumes, GaussiansStandUprightAndWhereTheirSceneSays) {
  write_gaussians("b.ply", 0);
  const LoadedScene there = must_load(planned(folder_ / "b.ply"));
  ASSERT_TRUE(there.gaussians);
  EXPECT_FALSE(there.volume);
  const LoadedScene scene = must_load(planned(write("scene.json", R"({"models": [{"file": "b.ply",
      "transform": {"translation": [0, 0, 7]}}], "views": [{"name": "a"}]})")));
  ASSERT_TRUE(scene.gaussians);
  EXPECT_FLOAT_EQ(scene.gaussians->centres[0].z, there.gaussians->centres[0].z + 7.0F);
  EXPECT_NEAR(scene.patches.bounds.min.z, there.patches.bounds.min.z + 7.0, 1e-5);
}

TEST_F(LoadingVolumes, DamagedFilesAreOneSentence) {
  const auto cut = write("cut.nrrd", small_nrrd().substr(0, 120));
  EXPECT_TRUE(error_of(planned(cut)).starts_with(cut.string() + ": ")) << error_of(planned(cut));
  const std::string whole = test::plain_ply(test::sample_scene(0), "binary_little_endian");
  const auto gaussians = write("cut.ply", whole.substr(0, whole.size() - 10));
  EXPECT_TRUE(error_of(planned(gaussians)).starts_with(gaussians.string() + ": "))
      << error_of(planned(gaussians));
}

}  // namespace
}  // namespace relief
