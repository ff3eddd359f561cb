// A file of each version, written when the version was made, decodes to the same values for ever.
// It is not to be made again: a change that breaks this test breaks everybody's files.
#include <gtest/gtest.h>

#include <numeric>

#include "common/patch_file/patch_tree.h"
#include "tests/common/patch_file/describe_model.h"
#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

std::filesystem::path frozen(const std::string& name) {
  return std::filesystem::path(RELIEF_TEST_DATA) / name;
}

class FrozenPatchFile : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Versions, FrozenPatchFile,
                         testing::Values("version1", "version2", "version1_scalars",
                                         "version2_scalars"));

TEST_P(FrozenPatchFile, DecodesAsItAlwaysDid) {
  const std::string name = GetParam();
  const PatchModel model = test::read_whole(frozen(name + ".relief"));
  EXPECT_FALSE(model.is_closed);  // version1 is older than the flag: not known
  EXPECT_EQ(test::describe(model), test::slurp(frozen(name + ".txt")));
}

class FrozenPatchTree : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Files, FrozenPatchTree, testing::Values("version3", "version3_seams"));

/// All patches as they are in the file: read_all() joins the normals of those that meet.
PatchModel read_apart(const PatchFile& file) {
  Progress progress;
  PatchModel model = *file.read_all(progress);
  std::vector<std::uint64_t> all(model.patches.size());
  std::iota(all.begin(), all.end(), 0U);
  model.patches = *file.read_patches(all, progress);
  return model;
}

TEST_P(FrozenPatchTree, DecodesAsItAlwaysDid) {
  const std::string name = GetParam();
  const auto tree = PatchTree::open(frozen(name + ".relief"));
  ASSERT_TRUE(tree) << tree.error().message;
  PatchModel extent = tree->extent();
  extent.joined = PatchFile::open(frozen(name + ".relief"))->joined();
  std::string text = test::describe(extent);
  for (std::uint32_t t = 0; t < tree->tiles().size(); ++t) {
    const TreeTile& tile = tree->tiles()[t];
    const std::string parent = tile.parent == kNoTile ? "none" : fmt::format("{}", tile.parent);
    text += fmt::format("tile of level {} under {}\nbox {} {}\n", tile.level, parent,
                        test::describe(tile.box.min), test::describe(tile.box.max));
    const auto file = tree->open_tile(t);
    ASSERT_TRUE(file) << file.error().message;
    text += test::describe(read_apart(*file));
  }
  EXPECT_EQ(text, test::slurp(frozen(name + ".txt")));
}

}  // namespace
}  // namespace relief
