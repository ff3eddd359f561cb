#include "renderer/view/patches_in_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/common/patch_file/sample_models.h"
#include "tests/renderer/images.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

/// A square of 16 by 16 tiles with overviews of 8 by 8, 4 by 4, 2 by 2 and 1, spacing 0.01 at the
/// finest, on the plane z = 0 from (0, 0) to (16, 16).
std::vector<TreeTile> quad_tree() {
  std::vector<TreeTile> tiles;
  std::uint32_t above = kNoTile;
  for (std::uint32_t level = 4; level <= 4; --level) {
    const auto first = static_cast<std::uint32_t>(tiles.size());
    const std::uint32_t side = 16U >> level;
    const double size = 16.0 / side;
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t i = 0; i < side; ++i) {
        TreeTile tile;
        tile.level = level;
        tile.parent = above == kNoTile ? kNoTile : above + j / 2 * (side / 2) + i / 2;
        tile.samples = 10000;
        tile.spacing = std::ldexp(0.01, static_cast<int>(level));
        tile.box = {{size * i, size * j, 0.0}, {size * (i + 1), size * (j + 1), 0.1}};
        tiles.push_back(tile);
      }
    }
    above = first;
  }
  return tiles;
}

RenderSettings looking(glm::dvec3 eye, glm::dvec3 target) {
  RenderSettings settings;
  settings.width = settings.height = 1000;
  settings.camera.eye = eye;
  settings.camera.target = target;
  settings.camera.up = {0.0, 1.0, 0.0};
  settings.camera.vertical_fov_degrees = 53.13010235;  // as wide as deep
  return settings;
}

std::vector<std::uint32_t> chosen_by(const std::vector<TreeTile>& tiles,
                                     const std::vector<RenderSettings>& views,
                                     const std::vector<Transform>& transforms = {Transform()}) {
  return choose_tiles(tiles, onlookers_of(views, transforms, PatchModel()));
}

/// Each transform of the square that is seen is in one chosen tile.
void expect_cover(const std::vector<TreeTile>& tiles, const std::vector<std::uint32_t>& chosen,
                  const std::function<bool(double, double)>& is_seen) {
  for (double y = 0.5; y < 16.0; y += 1.0) {
    for (double x = 0.5; x < 16.0; x += 1.0) {
      std::size_t covering = 0;
      for (const std::uint32_t t : chosen) {
        const Bounds& box = tiles[t].box;
        covering += x > box.min.x && x < box.max.x && y > box.min.y && y < box.max.y ? 1 : 0;
      }
      EXPECT_LE(covering, 1U) << x << ", " << y;
      if (is_seen(x, y)) {
        EXPECT_EQ(covering, 1U) << x << ", " << y;
      }
    }
  }
}

TEST(PatchesInView, FromFarAwayTheCoarsestTileIsEnough) {
  const auto tiles = quad_tree();
  // At a distance of 165 a pixel is 0.165 wide, at 155 less than the 0.16 of the coarsest samples.
  EXPECT_EQ(chosen_by(tiles, {looking({8, 8, 165}, {8, 8, 0})}), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(chosen_by(tiles, {looking({8, 8, 155}, {8, 8, 0})}),
            (std::vector<std::uint32_t>{1, 2, 3, 4}));
}

TEST(PatchesInView, NearTheEyeTilesAreFineAndFarOffCoarse) {
  const auto tiles = quad_tree();
  // Along the ground: one unit over the first row, toward the last.
  const auto chosen = chosen_by(tiles, {looking({8.5, 0.5, 1.0}, {8.5, 30.0, 0.0})});
  std::set<std::uint32_t> levels;
  for (const std::uint32_t t : chosen) {
    levels.insert(tiles[t].level);
    const double nearest = std::max(tiles[t].box.min.y - 0.5, 0.0);
    // No sample is more than about a pixel wide, and none is finer than its distance asks for but
    // by the two of a level and the depth of its parent.
    EXPECT_LE(tiles[t].spacing, std::max(0.001 * nearest * 1.1, 0.0101));
  }
  EXPECT_EQ(*levels.begin(), 0U);
  EXPECT_GE(levels.size(), 1U);
  expect_cover(tiles, chosen,
               [](double x, double y) { return y > 2.0 && std::abs(x - 8.5) < 0.45 * (y - 0.5); });
}

TEST(PatchesInView, OutsideTheViewAreLeftOut) {
  const auto tiles = quad_tree();
  EXPECT_TRUE(chosen_by(tiles, {looking({8, 8, 5}, {8, 8, 50})}).empty());
  // Two units over the middle of a tile, of which a square of two is seen.
  const auto chosen = chosen_by(tiles, {looking({4.5, 4.5, 2.0}, {4.5, 4.5, 0.0})});
  for (const std::uint32_t t : chosen) EXPECT_EQ(tiles[t].level, 0U);
  EXPECT_LE(chosen.size(), 16U);
  expect_cover(tiles, chosen,
               [](double x, double y) { return std::abs(x - 4.5) < 1 && std::abs(y - 4.5) < 1; });
}

TEST(PatchesInView, TheFinestViewDecides) {
  const auto tiles = quad_tree();
  const auto far = looking({8, 8, 165}, {8, 8, 0});
  const auto near = looking({4.5, 4.5, 2.0}, {4.5, 4.5, 0.0});
  const auto chosen = chosen_by(tiles, {far, near});
  EXPECT_GT(chosen.size(), 4U);
  expect_cover(tiles, chosen, [](double, double) { return true; });
  for (const std::uint32_t t : chosen_by(tiles, {near}))
    EXPECT_TRUE(std::find(chosen.begin(), chosen.end(), t) != chosen.end()) << t;
}

TEST(PatchesInView, DependOnPositionAndScale) {
  const auto tiles = quad_tree();
  Transform transform;
  transform.translation = {-80.0, -80.0, 0.0};
  transform.scale = 10.0;
  // Ten times as large at ten times the distance.
  EXPECT_EQ(chosen_by(tiles, {looking({0, 0, 1650}, {0, 0, 0})}, {transform}),
            (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(chosen_by(tiles, {looking({0, 0, 1550}, {0, 0, 0})}, {transform}).size(), 4U);
}

TEST(PatchesInView, DependOnSamplesPerPixelAndOrthographicHeight) {
  const auto tiles = quad_tree();
  RenderSettings settings = looking({8, 8, 165}, {8, 8, 0});
  settings.samples = 4;
  EXPECT_EQ(chosen_by(tiles, {settings}).size(), 4U);
  settings = looking({8, 8, 20}, {8, 8, 0});
  settings.camera.orthographic_height = 161.0;
  EXPECT_EQ(chosen_by(tiles, {settings}).size(), 1U);
  settings.camera.orthographic_height = 159.0;
  EXPECT_EQ(chosen_by(tiles, {settings}).size(), 4U);
}

TEST(PatchesInView, ChildrenStandInForATileWithoutSamples) {
  auto tiles = quad_tree();
  tiles[0].samples = tiles[2].samples = 0;
  tiles[0].box = tiles[2].box = Bounds{};
  const auto chosen = chosen_by(tiles, {looking({8, 8, 1650}, {8, 8, 0})});
  EXPECT_EQ(chosen.size(), 7U);
  expect_cover(tiles, chosen, [](double, double) { return true; });
}

TEST(PatchesInView, DrawnAtTheFinestLevelUseNoOverviews) {
  const auto tiles = quad_tree();
  RenderSettings settings = looking({8, 8, 165}, {8, 8, 0});
  settings.pixels_per_sample = 0.0;
  EXPECT_EQ(chosen_by(tiles, {settings}).size(), 256U);
  settings.pixels_per_sample.reset();
  settings.primitive = Primitive::Quad;
  EXPECT_EQ(chosen_by(tiles, {settings}).size(), 256U);
  settings.primitive = Primitive::Cell;
  settings.engine = "multipass";
  EXPECT_EQ(chosen_by(tiles, {settings}).size(), 256U);
}

/// What reaches beside the eye is in the image only farther ahead. Taken for nearest, it took the
/// memory that the tile before the eye needs.
TEST(PatchesInView, BesideTheEyeTilesAreNotNearest) {
  const auto onlookers = onlookers_of(std::vector{looking({8.0, 8.0, 0.5}, {8.0, 20.0, 0.0})},
                                      std::vector<Transform>(1), PatchModel());
  const Bounds before{{7.5, 8.7, 0.0}, {8.5, 9.7, 0.1}};
  const Bounds beside{{9.0, 7.5, 0.0}, {13.0, 11.5, 0.1}};
  // At a depth of 1 a pixel is 0.001 wide.
  EXPECT_NEAR(coarseness(onlookers, before, 0.01), 0.01 / 0.0007, 0.4);
  const double nearest = std::hypot(1.0, 0.4) / std::sqrt(1.5);
  EXPECT_NEAR(coarseness(onlookers, beside, 0.01), 0.01 / (0.001 * nearest), 0.4);
}

/// Half floats' last bit: colours of fewer patches lie elsewhere in their texture, where
/// coordinates round otherwise.
void expect_same_image(const Image& a, const Image& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    for (std::size_t k = 0; k < a.channels[c].values.size(); ++k) {
      const float x = a.channels[c].values[k];
      const float y = b.channels[c].values[k];
      ASSERT_TRUE(x == y || std::abs(x - y) < 1e-3F) << a.channels[c].name << x << " " << y;
    }
  }
}

/// What is not read is not seen: the image is that of the whole model.
TEST(PatchesInView, ImagesOfPartsAreThoseOfTheWhole) {
  const test::ScratchFolder folder;
  test::SphereShape shape;
  shape.bumps = 0.1;
  shape.spacing = 0.015;
  shape.patches_per_side = 8;
  const PatchModel model = test::sphere_model(shape);
  ASSERT_TRUE(write_patch_file(folder / "sphere", model));
  const auto tree = PatchTree::open(folder / "sphere");
  ASSERT_TRUE(tree) << tree.error().message;
  Progress progress;
  const PatchModel whole = *PatchFile::open(folder / "sphere")->read_all(progress);
  for (const double degrees : {4.0, 45.0}) {
    RenderSettings settings = test::small_image(model, {30.0, 20.0, 2.0}, 96);
    settings.camera.vertical_fov_degrees = degrees;
    settings.outputs = test::all_outputs();
    settings.outputs.patch_id = false;  // counts what was read
    const std::vector<RenderSettings> views{settings};
    const std::vector<Transform> transforms(1);
    const auto read = read_in_view(*tree, onlookers_of(views, transforms, whole), progress);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_LT(read->model.patches.size(), degrees < 10.0 ? 80U : 385U);
    EXPECT_EQ(read->samples, count_samples(read->model));
    expect_same_image(test::must_render(read->model, settings).image,
                      test::must_render(whole, settings).image);
  }
}

/// Two tiles whose patches meet, read in part and as a whole: each is stitched for itself.
TEST(PatchesInView, EachTileIsARunOfPatchesThatMeet) {
  const test::ScratchFolder folder;
  test::SphereShape shape;
  shape.spacing = 0.015;
  shape.patches_per_side = 8;
  const PatchModel model = test::sphere_model(shape);
  const std::size_t half = model.patches.size() / 2;
  const auto write = [&](const char* name, std::size_t first) {
    PatchModel part = model;
    part.patches.assign(model.patches.begin() + static_cast<std::ptrdiff_t>(first),
                        model.patches.begin() + static_cast<std::ptrdiff_t>(first + half));
    part.joined = {{0, static_cast<std::uint32_t>(half)}};
    EXPECT_TRUE(write_patch_file(folder / name, part));
    return TreePart{folder / name};
  };
  ASSERT_TRUE(write_patch_tree(folder / "tree", {write("a", 0), write("b", half)}, model));
  const auto tree = PatchTree::open(folder / "tree");
  ASSERT_TRUE(tree) << tree.error().message;
  Progress progress;
  const PatchModel whole = *PatchFile::open(folder / "tree")->read_all(progress);
  ASSERT_EQ(whole.joined.size(), 2U);
  for (const double degrees : {4.0, 70.0}) {
    RenderSettings settings = test::small_image(model, {30.0, 20.0, 2.0}, 96);
    settings.camera.vertical_fov_degrees = degrees;
    const std::vector<RenderSettings> views{settings};
    const std::vector<Transform> transforms(1);
    const auto read = read_in_view(*tree, onlookers_of(views, transforms, whole), progress);
    ASSERT_TRUE(read) << read.error().message;
    std::uint32_t patches = 0;
    for (const PatchRun& run : read->model.joined) {
      EXPECT_EQ(run.first, patches);
      patches += run.count;
    }
    EXPECT_EQ(read->model.joined.size(), read->tiles);
    EXPECT_EQ(patches, read->model.patches.size());
    EXPECT_EQ(patches == whole.patches.size(), degrees > 20.0);
    const Image image = test::must_render(read->model, settings).image;
    expect_same_image(image, test::must_render(whole, settings).image);
    // Seams are part of it.
    PatchModel apart = read->model;
    apart.joined.clear();
    EXPECT_NE(test::values(image, "R"),
              test::values(test::must_render(apart, settings).image, "R"));
  }
}

}  // namespace
}  // namespace relief
