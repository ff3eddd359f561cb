// A file of each version, written when the version was made, decodes to the same values for ever.
// It is not to be made again: a change that breaks this test breaks everybody's files.
#include <gtest/gtest.h>

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
INSTANTIATE_TEST_SUITE_P(Versions, FrozenPatchFile, testing::Values("version1", "version2"));

TEST_P(FrozenPatchFile, DecodesAsItAlwaysDid) {
  const std::string name = GetParam();
  const PatchModel model = test::read_whole(frozen(name + ".relief"));
  EXPECT_FALSE(model.is_closed);  // version1 is older than the flag: not known
  EXPECT_EQ(test::describe(model), test::slurp(frozen(name + ".txt")));
}

TEST(FrozenPatchTree, DecodesAsItAlwaysDid) {
  const auto tree = PatchTree::open(frozen("version3.relief"));
  ASSERT_TRUE(tree) << tree.error().message;
  std::string text = test::describe(tree->extent());
  for (std::uint32_t t = 0; t < tree->tiles().size(); ++t) {
    const TreeTile& tile = tree->tiles()[t];
    const std::string parent = tile.parent == kNoTile ? "none" : fmt::format("{}", tile.parent);
    text += fmt::format("tile of level {} under {}\nbox {} {}\n", tile.level, parent,
                        test::describe(tile.box.min), test::describe(tile.box.max));
    const auto file = tree->open_tile(t);
    ASSERT_TRUE(file) << file.error().message;
    Progress progress;
    const auto model = file->read_all(progress);
    ASSERT_TRUE(model) << model.error().message;
    text += test::describe(*model);
  }
  EXPECT_EQ(text, test::slurp(frozen("version3.txt")));
}

}  // namespace
}  // namespace relief
