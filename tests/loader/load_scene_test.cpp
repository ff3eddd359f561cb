// What the loader makes of files that a user names. It prints nothing: notes go to the progress.
#include "loader/load_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "loader/load_files.h"
#include "loader/scene/view_settings.h"
#include "models/knot_scan.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

/// Keeps the notes.
class Notes final : public Progress {
 public:
  void note(std::string_view text) override { notes.emplace_back(text); }
  std::vector<std::string> notes;
};

class Loading : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    test::spill(folder_ / name.c_str(), text);
    return folder_ / name.c_str();
  }
  LoadedScene must_load(const std::filesystem::path& file, const std::string& engine) {
    SceneSettings settings;
    settings.engine = engine;
    const auto plan = plan_scene(file, settings);
    EXPECT_TRUE(plan) << plan.error().message;
    auto scene = load_scene(*plan, {}, notes_);
    if (scene) return std::move(*scene);
    ADD_FAILURE() << scene.error().message;
    return {};
  }

  test::ScratchFolder folder_;
  Notes notes_;
};

/// A square of 5 x 5 points, 0 to 4 in X and Y, with 32 triangles, as OFF.
std::string square_off() {
  std::string off = "OFF\n25 32 0\n";
  for (int k = 0; k < 25; ++k) off += fmt::format("{} {} 0\n", k % 5, k / 5);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i;
      off += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, a + 1, a + 6, a, a + 6, a + 5);
    }
  }
  return off;
}

/// A pyramid, three times as high as half its base is wide, as OBJ. It would fall over on its side.
std::string pyramid_obj(bool z_is_up) {
  const auto vertex = [z_is_up](int x, int y, int z) {
    return z_is_up ? fmt::format("v {} {} {}\n", x, y, z) : fmt::format("v {} {} {}\n", x, z, -y);
  };
  return vertex(-1, -1, 0) + vertex(1, -1, 0) + vertex(1, 1, 0) + vertex(-1, 1, 0) +
         vertex(0, 0, 3) + "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
}

TEST_F(Loading, MeshesStandAsTheyCan) {
  const auto stance_in = [&](const std::vector<std::filesystem::path>& files) {
    const auto read = load_points(files, {}, notes_);
    EXPECT_TRUE(read) << read.error().message;
    return read ? stance_of(read->points) : Stance{};
  };
  const auto z_up = write("z_up.obj", pyramid_obj(true));
  const auto y_up = write("y_up.obj", pyramid_obj(false));
  EXPECT_EQ(stance_in({z_up}), kZUp);
  EXPECT_EQ(stance_in({y_up}), Stance{});
  EXPECT_EQ(stance_in({z_up, write("more.obj", pyramid_obj(true))}), kZUp);
  EXPECT_EQ(must_load(z_up, "onepass").patches.stance, kZUp);
  EXPECT_EQ(must_load(z_up, "raytrace").patches.stance, kZUp);
}

TEST_F(Loading, OtherFilesAreScenesOfOneModelAndOneView) {
  SceneSettings overrides;
  overrides.fov_degrees = 30.0;
  const auto plan = plan_scene(folder_ / "none.ply", overrides);
  ASSERT_TRUE(plan) << "no file is opened yet";
  ASSERT_EQ(plan->models.size(), 1U);
  ASSERT_EQ(plan->views.size(), 1U);
  EXPECT_EQ(plan->views.front().name, "");
  EXPECT_EQ(plan->views.front().settings.fov_degrees, 30.0);
  const auto missing = find_inputs(*plan);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, (folder_ / "none.ply").string() + ": there is no such file");
}

TEST_F(Loading, GivesEachEngineTheFormThatItPrefers) {
  const auto scan = write("knot.ply", knot_scan_ply(3000));
  const LoadedScene patches = must_load(scan, "onepass");
  EXPECT_FALSE(patches.patches.patches.empty());
  EXPECT_FALSE(patches.mesh || patches.splats);
  const LoadedScene splats = must_load(scan, "ewa");
  ASSERT_TRUE(splats.splats);
  const auto read = load_points({scan}, {}, notes_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(splats.splats->positions.size(), read->points.size());
  EXPECT_TRUE(splats.patches.patches.empty());
  // The camera depends on the bounds, and these not on the engine.
  EXPECT_EQ(splats.patches.bounds.min, patches.patches.bounds.min);
  const LoadedScene of_patches = must_load(scan, "raytrace");
  ASSERT_TRUE(of_patches.mesh);
  EXPECT_FALSE(of_patches.mesh_is_input) << "a scan has no triangles of its own";
  const LoadedScene mesh = must_load(write("square.off", square_off()), "raytrace");
  ASSERT_TRUE(mesh.mesh);
  EXPECT_EQ(mesh.mesh->triangles.size(), 32U);
  EXPECT_TRUE(mesh.mesh_is_input);
  EXPECT_TRUE(notes_.notes.empty());
}

TEST_F(Loading, PutsInstancesInTheirPositions) {
  write("square.off", square_off());
  const auto file = write("scene.json", R"({"models": [{"file": "square.off"},
      {"file": "square.off", "transform": {"translation": [10, 0, 0]}, "material": "mirror"}],
      "views": [{"name": "a", "engine": "raytrace"}, {"name": "b", "material": "unlit"}]})");
  const auto plan = plan_scene(file, {});
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->views[1].materials.size(), 2U);
  EXPECT_EQ(plan->views[1].materials[0].kind, Material::Unlit);
  EXPECT_EQ(plan->views[1].materials[1].kind, Material::Mirror) << "the model's own wins";
  const auto scene = load_scene(*plan, {}, notes_);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->patches.instances.size(), 2U);
  EXPECT_EQ(scene->mesh->triangles.size(), 64U);
  EXPECT_EQ(scene->patches.bounds.max.x, 14.0);
  const auto views = render_settings_of(*plan, scene->patches);
  ASSERT_TRUE(views) << views.error().message;
  EXPECT_EQ((*views)[0].engine, "raytrace");
  EXPECT_EQ((*views)[1].engine, "onepass");
}

TEST_F(Loading, NotesWhatOnlySomeOfTheScansHave) {
  const auto plain = write("plain.off", square_off());
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "end_header\n9 9 9 1 2 3\n";
  const auto read = load_points({plain, write("coloured.ply", header)}, {}, notes_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->points.size(), 26U);
  EXPECT_TRUE(read->points.colours.empty());
  EXPECT_EQ(notes_.notes,
            (std::vector<std::string>{"only some of the scans have colours; they are left out"}));
}

}  // namespace
}  // namespace relief
