#include "common/patch_file_join.h"

#include <gtest/gtest.h>

#include "tests/common/read_whole.h"
#include "tests/common/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::read_whole;
using test::ScratchFolder;
using test::slurp;
using test::spill;

/// The patches [first, last) of a model, with its bounds and spacing.
PatchModel part_of(const PatchModel& model, std::size_t first, std::size_t last) {
  PatchModel part = model;
  part.patches.assign(model.patches.begin() + static_cast<std::ptrdiff_t>(first),
                      model.patches.begin() + static_cast<std::ptrdiff_t>(last));
  return part;
}

JoinedModel whole_of(const PatchModel& model) {
  return {model.spacing, model.bounds, model.bounding_radius};
}

PatchFileOptions with(PatchCodec codec) {
  PatchFileOptions options;
  options.codec = codec;
  return options;
}

void expect_same(const Patch& a, const Patch& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.axes, b.axes);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.height_step, b.height_step);
  EXPECT_EQ(a.heights, b.heights);
  EXPECT_EQ(a.normals.texels, b.normals.texels);
  EXPECT_EQ(a.colours.texels, b.colours.texels);
}

class PatchFileJoinOf : public testing::TestWithParam<PatchCodec> {};

TEST_P(PatchFileJoinOf, PatchesAreThoseOfTheParts) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(9, 2);
  // The least height step says how exactly a compact file keeps places: the parts differ in it.
  model.patches[1].height_step /= 3.0;
  const std::size_t count = model.patches.size();
  const std::size_t cuts[] = {0, 1, 1, 4, count};  // one part has none
  std::vector<std::filesystem::path> parts;
  std::vector<Patch> expected;
  for (std::size_t p = 0; p + 1 < std::size(cuts); ++p) {
    parts.push_back(folder / std::to_string(p).c_str());
    const PatchModel part = part_of(model, cuts[p], cuts[p + 1]);
    ASSERT_TRUE(write_patch_file(parts.back(), part, with(GetParam())));
    for (const Patch& patch : read_whole(parts.back()).patches) expected.push_back(patch);
  }
  ASSERT_TRUE(join_patch_files(folder / "joined", parts, whole_of(model)));
  const PatchModel joined = read_whole(folder / "joined");
  ASSERT_EQ(joined.patches.size(), count);
  for (std::size_t p = 0; p < count; ++p) {
    SCOPED_TRACE(p);
    expect_same(joined.patches[p], expected[p]);
  }
  EXPECT_EQ(joined.spacing, model.spacing);
  EXPECT_EQ(joined.bounds.max, model.bounds.max);
  EXPECT_EQ(joined.bounding_radius, model.bounding_radius);
}

INSTANTIATE_TEST_SUITE_P(Codecs, PatchFileJoinOf,
                         testing::Values(PatchCodec::Fast, PatchCodec::Compact));

TEST(PatchFileJoin, OnePartIsTheFileItself) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5, 0);
  ASSERT_TRUE(write_patch_file(folder / "a", model));
  ASSERT_TRUE(join_patch_files(folder / "b", {folder / "a"}, whole_of(model)));
  EXPECT_TRUE(slurp(folder / "a") == slurp(folder / "b"));
}

TEST(PatchFileJoin, PartsOfTwoVersionsAndDamagedOnesAreRefused) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5, 0);
  ASSERT_TRUE(write_patch_file(folder / "fast", model, with(PatchCodec::Fast)));
  ASSERT_TRUE(write_patch_file(folder / "compact", model, with(PatchCodec::Compact)));
  const Status mixed =
      join_patch_files(folder / "joined", {folder / "fast", folder / "compact"}, whole_of(model));
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().message.find("is of version 2, other parts of version 1"),
            std::string::npos);
  const std::string good = slurp(folder / "fast");
  spill(folder / "cut", good.substr(0, good.size() / 2));
  EXPECT_FALSE(join_patch_files(folder / "joined", {folder / "cut"}, whole_of(model)));
  EXPECT_FALSE(std::filesystem::exists(folder / "joined"));
}

}  // namespace
}  // namespace relief
