// Picked points of a file with tiles, against the patches that it has.
#include "viewer/measuring/tile_picker.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <glm/geometric.hpp>
#include <optional>

#include "common/patch_file/patch_tree.h"
#include "tests/loader/stream/sphere_tree.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

class PicksInTiles : public testing::Test {
 protected:
  /// Once: writing takes the longest.
  static void SetUpTestSuite() {
    scratch.emplace();
    test::write_sphere_tree(file());
  }
  static void TearDownTestSuite() { scratch.reset(); }

  [[nodiscard]] static std::filesystem::path file() { return *scratch / "tree.relief"; }

  static std::shared_ptr<TileSource> open(const std::filesystem::path& path = file()) {
    ScenePlan plan;
    plan.models.push_back({path, {}, {}, {}});
    auto source = TileSource::open(plan);
    EXPECT_TRUE(source) << source.error().message;
    return *source;
  }

  /// A patch of a tile, as the file has it.
  static PatchModel patch_of(std::uint32_t tile, std::uint32_t patch) {
    const auto tree = PatchTree::open(file());
    auto opened = tree->open_tile(tile);
    EXPECT_TRUE(opened) << opened.error().message;
    Progress silent;
    auto read = opened->read_patches(std::array{std::uint64_t{patch}}, silent);
    EXPECT_TRUE(read) << read.error().message;
    return test::model_of({read->front()});
  }

  /// The middle of a patch, seen along its axis from 3 away with single precision.
  static PickQuery query_of(const Patch& patch, std::uint32_t id) {
    const std::uint32_t i = patch.width / 2;
    const std::uint32_t j = patch.height / 2;
    const glm::dvec3 node(i * patch.spacing, j * patch.spacing, patch.at(i, j) * patch.height_step);
    const glm::dvec3 position = patch.origin + patch.axes * node;
    return {position + 3.0 * patch.axes[2], -patch.axes[2], 3.0 * (1.0 + 1e-7), 0.02, id, {}};
  }

  static std::optional<test::ScratchFolder> scratch;
};

std::optional<test::ScratchFolder> PicksInTiles::scratch;

TEST_F(PicksInTiles, AreThoseOfTheTilesOwnPatches) {
  const auto source = open();
  TilePicker picker;
  // The first tile has patches 0 to 23, as has each of the finer ones.
  for (const std::uint32_t id : {5U, 24U, 47U, 48U, 119U, 24U}) {
    const PatchModel alone = patch_of(id / 24, id % 24);
    const auto expected = SurfacePicker(alone).pick(query_of(alone.patches.front(), 0));
    ASSERT_TRUE(expected);
    const auto found = picker.pick(source, query_of(alone.patches.front(), id));
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(*found);
    EXPECT_EQ((*found)->position, expected->position);
    EXPECT_EQ((*found)->normal, expected->normal);
    EXPECT_EQ((*found)->patch, id);
  }
}

TEST_F(PicksInTiles, TryOtherPatches) {
  const auto source = open();
  TilePicker picker;
  const PatchModel alone = patch_of(2, 3);
  PickQuery query = query_of(alone.patches.front(), 119);
  EXPECT_FALSE(*picker.pick(source, query)) << "patch 119 is elsewhere";
  const std::array others{5U, 51U};
  query.others = others;
  const auto found = picker.pick(source, query);
  ASSERT_TRUE(found && *found);
  EXPECT_TRUE((*found)->patch == 5 || (*found)->patch == 51);
}

TEST_F(PicksInTiles, SayWhyThereIsNone) {
  const std::filesystem::path copy = *scratch / "copy.relief";
  std::filesystem::copy_file(file(), copy);
  const auto source = open(copy);
  std::filesystem::remove(copy);
  TilePicker picker;
  const auto found = picker.pick(source, {{0, 0, 3}, {0, 0, -1}, 2.0, 0.02, 24, {}});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message,
            copy.string() + ": has vanished while it was shown; what has been read of it stays");
}

}  // namespace
}  // namespace relief
