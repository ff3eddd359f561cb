// What is read of patch files: only what the views show.
#include "loader/scene/patch_sections.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/patch_file/patch_tree.h"
#include "loader/load_scene.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "models/knot_scan.h"
#include "renderer/render.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

class ShownSections : public testing::Test {
 protected:
  static PatchModel sphere(double spacing, bool coloured) {
    test::SphereShape shape;
    shape.spacing = spacing;
    shape.coloured = coloured;
    shape.patches_per_side = 2;
    return test::sphere_model(shape);
  }
  std::filesystem::path write_sphere(bool coloured = true) {
    const auto path = folder_ / "sphere.relief";
    EXPECT_TRUE(write_patch_file(path, sphere(0.1, coloured)));
    return path;
  }

  static ScenePlan plan_of(const std::filesystem::path& file, const SceneSettings& settings) {
    const auto plan = plan_scene(file, settings);
    EXPECT_TRUE(plan) << plan.error().message;
    return plan ? *plan : ScenePlan{};
  }
  static PatchSections sections_for(const std::filesystem::path& file,
                                    const SceneSettings& settings, bool by_scalar = false) {
    const auto sections = sections_of(plan_of(file, settings), by_scalar);
    EXPECT_TRUE(sections) << sections.error().message;
    return sections ? *sections : PatchSections{};
  }
  LoadedScene load(const std::filesystem::path& file, const SceneSettings& settings,
                   KeptDetail detail = KeptDetail::OfViews) {
    LoadOptions options;
    options.detail = detail;
    auto scene = load_scene(plan_of(file, settings), options, silent_);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? std::move(*scene) : LoadedScene{};
  }
  /// The image of a scene that was loaded for these settings.
  Image draw(const std::filesystem::path& file, const SceneSettings& settings,
             const LoadedScene& scene) {
    const ScenePlan plan = plan_of(file, settings);
    auto views = render_settings_of(plan, scene.patches);
    EXPECT_TRUE(views) << views.error().message;
    complete_look(plan.views.front(), scene, views->front());
    auto drawn = render(scene.forms(), views->front(), silent_);
    EXPECT_TRUE(drawn) << drawn.error().message;
    return drawn ? std::move(drawn->image) : Image{};
  }
  static SceneSettings of_material(Material material) {
    SceneSettings settings;
    settings.material = material;
    settings.size = ImageSize{120, 96};
    return settings;
  }

  test::ScratchFolder folder_;
  Progress silent_;
};

TEST_F(ShownSections, AnUnlitImageNeedsNoNormals) {
  const auto file = write_sphere();
  EXPECT_EQ(sections_for(file, of_material(Material::Unlit)), (PatchSections{false, true, false}));
  EXPECT_EQ(sections_for(file, {}), (PatchSections{false, true, false}))
      << "coloured points are unlit by default";
  EXPECT_EQ(sections_for(file, of_material(Material::Lit)), (PatchSections{true, true, false}));
  EXPECT_EQ(sections_for(file, of_material(Material::Mirror)), (PatchSections{true, false, false}));
  SceneSettings with_normals = of_material(Material::Unlit);
  with_normals.outputs = Outputs{.normal = true};
  EXPECT_EQ(sections_for(file, with_normals), (PatchSections{true, true, false}));
  SceneSettings clipped = of_material(Material::Unlit);
  clipped.engine = "multipass";
  EXPECT_EQ(sections_for(file, clipped), (PatchSections{false, true, false}));
  clipped.options["clip-partners"] = std::string("partners");
  EXPECT_EQ(sections_for(file, clipped), (PatchSections{true, true, false}));
}

// Otherwise an unlit image, or a PNG, would have other seams than an EXR and the window.
TEST_F(ShownSections, SeamsNeedNormals) {
  PatchModel model = sphere(0.1, true);
  model.joined = {{0, static_cast<std::uint32_t>(model.patches.size()), true}};
  const auto file = folder_ / "joined.relief";
  for (const bool is_of_points : {false, true}) {
    model.is_of_points = is_of_points;
    ASSERT_TRUE(write_patch_file(file, model));
    EXPECT_EQ(sections_for(file, of_material(Material::Unlit)), (PatchSections{true, true, false}));
    EXPECT_EQ(sections_for(file, {}), (PatchSections{true, true, false}));
  }
}

TEST_F(ShownSections, ScalarsAreReadWhereTheyTakeThePlaceOfColours) {
  EXPECT_EQ(sections_for(write_sphere(), of_material(Material::Lit), true),
            (PatchSections{true, false, true}));
  // Colours that stand for numbers are lit by default.
  EXPECT_EQ(sections_for(write_sphere(), {}, true), (PatchSections{true, false, true}));
}

TEST_F(ShownSections, AreAllWhereSomethingElseIsMadeOfPatches) {
  const auto file = write_sphere();
  for (const char* const engine : {"raytrace", "ewa", "surfel"}) {
    SceneSettings settings = of_material(Material::Unlit);
    settings.engine = engine;
    EXPECT_EQ(sections_for(file, settings), PatchSections{}) << engine;
  }
  test::spill(folder_ / "knot.ply", knot_scan_ply(500));
  EXPECT_EQ(sections_for(folder_ / "knot.ply", of_material(Material::Unlit)), PatchSections{});
}

TEST_F(ShownSections, AreThoseOfAllViewsAndModels) {
  (void)write_sphere();
  ASSERT_TRUE(write_patch_file(folder_ / "grey.relief", sphere(0.1, false)));
  const auto scene = folder_ / "scene.json";
  test::spill(scene, R"({"models": [{"file": "sphere.relief"}, {"file": "grey.relief"}],
      "views": [{"name": "a", "material": "unlit"}, {"name": "b", "material": "mirror"}]})");
  EXPECT_EQ(sections_for(scene, {}), (PatchSections{true, true, false}));
  test::spill(scene, R"({"models": [{"file": "grey.relief", "material": "mirror"}],
      "views": [{"name": "a"}]})");
  EXPECT_EQ(sections_for(scene, {}), (PatchSections{true, false, false}));
}

TEST_F(ShownSections, NoByteOfWhatIsNotShownIsRead) {
  const auto file = write_sphere();
  const PatchFileInfo info = PatchFile::open(file)->info();
  ASSERT_GT(info.normal_bytes, 0U);
  ASSERT_GT(info.colour_bytes, 0U);
  EXPECT_EQ(load(file, of_material(Material::Unlit)).read,
            (SectionBytes{info.height_bytes, 0, info.colour_bytes, 0}));
  EXPECT_EQ(load(file, of_material(Material::Mirror)).read,
            (SectionBytes{info.height_bytes, info.normal_bytes, 0, 0}));
  EXPECT_EQ(load(file, of_material(Material::Unlit), KeptDetail::All).read,
            (SectionBytes{info.height_bytes, info.normal_bytes, info.colour_bytes, 0}));
}

/// Every way to draw: what is not read shows nowhere, not even in the shape of splats at borders.
TEST_F(ShownSections, TheImageIsThatOfTheWholeFile) {
  const auto file = write_sphere();
  for (const char* const engine : {"onepass", "multipass"}) {
    for (const char* const primitive : {"cell", "quad", "sprite"}) {
      if (std::string_view(engine) == "multipass" && std::string_view(primitive) == "cell")
        continue;
      for (const Material material : {Material::Unlit, Material::Lit, Material::Mirror}) {
        SceneSettings settings = of_material(material);
        settings.engine = engine;
        settings.options["primitive"] = std::string(primitive);
        const Image some = draw(file, settings, load(file, settings));
        const Image all = draw(file, settings, load(file, settings, KeptDetail::All));
        for (const char* const channel : {"R", "G", "B", "A"})
          EXPECT_EQ(test::values(some, channel), test::values(all, channel))
              << engine << " " << primitive << " " << channel;
      }
    }
  }
}

/// Of a file with tiles a distant image reads overviews: their colours, not the fine ones.
TEST_F(ShownSections, ADistantImageReadsNoFineColours) {
  const PatchModel fine = sphere(0.01, true);
  const PatchModel coarse = sphere(0.04, true);
  ASSERT_TRUE(write_patch_file(folder_ / "coarse", coarse));
  ASSERT_TRUE(write_patch_file(folder_ / "fine", fine));
  const auto tree = folder_ / "tree.relief";
  ASSERT_TRUE(write_patch_tree(
      tree, {TreePart{folder_ / "coarse", 1, kNoTile}, TreePart{folder_ / "fine", 0, 0}}, fine));
  const std::uint64_t coarse_bytes = PatchFile::open(folder_ / "coarse")->info().colour_bytes;
  const std::uint64_t fine_bytes = PatchFile::open(folder_ / "fine")->info().colour_bytes;
  ASSERT_GT(fine_bytes, 4 * coarse_bytes);
  SceneSettings settings = of_material(Material::Unlit);
  settings.size = ImageSize{32, 32};
  const LoadedScene distant = load(tree, settings);
  EXPECT_EQ(distant.read.colours, coarse_bytes);
  EXPECT_EQ(distant.read.normals, 0U);
  settings.size = ImageSize{2000, 2000};
  const LoadedScene near = load(tree, settings);
  EXPECT_GT(near.read.colours, coarse_bytes);
  EXPECT_LE(near.read.colours, fine_bytes);
}

/// A file without tiles has one chunk of colours a patch, which is read whole; what the image does
/// not show of it is dropped before it reaches the GPU.
TEST_F(ShownSections, ADistantImageKeepsNoFineTexels) {
  PatchModel model = sphere(0.1, true);
  for (Patch& patch : model.patches) {
    AttributeMap<glm::u8vec3> map{8 * (patch.width - 1) + 1, 8 * (patch.height - 1) + 1, 8, {}};
    map.texels.resize(std::size_t{map.width} * map.height, glm::u8vec3(90, 120, 150));
    patch.colours = std::move(map);
  }
  const auto file = folder_ / "textured.relief";
  ASSERT_TRUE(write_patch_file(file, model));
  SceneSettings settings = of_material(Material::Unlit);
  settings.size = ImageSize{3, 3};  // a cell is a fifth of a pixel
  for (const Patch& patch : load(file, settings).patches.patches)
    EXPECT_EQ(patch.colours.scale, 1U);
  for (const Patch& patch : load(file, settings, KeptDetail::All).patches.patches)
    EXPECT_EQ(patch.colours.scale, 8U);
  settings.size = ImageSize{4000, 4000};
  for (const Patch& patch : load(file, settings).patches.patches)
    EXPECT_EQ(patch.colours.scale, 8U);
}

}  // namespace
}  // namespace relief
