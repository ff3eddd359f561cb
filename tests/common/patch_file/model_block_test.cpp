#include "common/patch_file/model_block.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/extremes.h"
#include "common/io/bytes.h"
#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_file_layout.h"
#include "common/patch_file/patch_tree.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::ScratchFolder;

/// A model with everything that a block holds.
PatchModel placed_model() {
  PatchModel model = bumpy_model(2, 1);
  model.extremes = extreme_points(corners_of(model.bounds), model.bounds);
  model.stance = kZUp;
  model.stance.is_from_sensor = true;
  return model;
}

TEST(ModelBlock, ComesBackFromEveryVersion) {
  const ScratchFolder folder;
  const PatchModel model = placed_model();
  Progress progress;
  for (const PatchCodec codec : {PatchCodec::Fast, PatchCodec::Compact}) {
    ASSERT_TRUE(write_patch_file(folder / "one.relief", model, {codec, 0.5}));
    const auto file = PatchFile::open(folder / "one.relief");
    ASSERT_TRUE(file) << file.error().message;
    const auto read = file->read_all(progress);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->extremes, model.extremes);
    EXPECT_EQ(read->stance, model.stance);
    EXPECT_EQ(count_samples(*read), count_samples(model));
  }
  ASSERT_TRUE(write_patch_tree(folder / "tree.relief", {{folder / "one.relief"}}, model));
  const auto tree = PatchTree::open(folder / "tree.relief");
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->extent().extremes, model.extremes);
  EXPECT_EQ(tree->extent().stance, model.stance);
  const auto file = PatchFile::open(folder / "tree.relief");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->info().stance, model.stance);
  EXPECT_TRUE(file->read_all(progress));
}

TEST(ModelBlock, TakesNoBytesWhereItSaysNothing) {
  EXPECT_TRUE(write_model_block({}, {{0, 0, 0}, {1, 1, 1}}).empty());
  EXPECT_TRUE(write_model_block({{{0, 0, 0}}, {}}, Bounds{}).empty());
}

TEST(ModelBlock, SkipsEntriesOfUnknownTypes) {
  const Bounds bounds{{0, 0, 0}, {1, 1, 1}};
  std::vector<std::byte> bytes = write_model_block({corners_of(bounds), kZUp}, bounds);
  bytes.resize(bytes.size() - 4);
  for (const char c : {'N', 'E', 'W', '!', '\2', '\0', '\0', '\0', 'a', 'b'})
    bytes.push_back(static_cast<std::byte>(c));
  append_number(bytes, crc32(bytes));
  const auto block = parse_model_block(bytes, bounds, "file");
  ASSERT_TRUE(block) << block.error().message;
  EXPECT_EQ(block->extremes.size(), 8U);
  EXPECT_EQ(block->stance, kZUp);
}

TEST(ModelBlock, IsRefusedWhereverItIsWrong) {
  const Bounds bounds{{0, 0, 0}, {1, 1, 1}};
  const std::vector<std::byte> whole = write_model_block({corners_of(bounds), kZUp}, bounds);
  const auto fault_of = [&bounds](std::vector<std::byte> content) {
    append_number(content, crc32(content));
    const auto block = parse_model_block(content, bounds, "file");
    return block ? std::string() : block.error().message;
  };
  const std::vector<std::byte> content(whole.begin(), whole.end() - 4);
  ASSERT_EQ(fault_of(content), "");
  // The first entry ends after 8 + 8 * 6 bytes; without the second one the block is whole.
  for (std::size_t length = 1; length < content.size(); ++length) {
    const std::vector<std::byte> cut(content.begin(),
                                     content.begin() + static_cast<std::ptrdiff_t>(length));
    if (length == 56) continue;
    EXPECT_EQ(fault_of(cut),
              "file: the model block is wrong: an entry is cut off; the file is damaged")
        << length;
  }
  std::vector<std::byte> flipped = whole;
  flipped[20] ^= std::byte{1};
  EXPECT_FALSE(parse_model_block(flipped, bounds, "file")) << "the checksum";
  ModelBlock crooked{{}, kZUp};
  crooked.stance.up = {0.0, 1.0, 1.0};
  EXPECT_NE(parse_model_block(write_model_block(crooked, bounds), bounds, "file")
                .error()
                .message.find("right angles"),
            std::string::npos);
  crooked.stance.up.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(parse_model_block(write_model_block(crooked, bounds), bounds, "file"));
}

}  // namespace
}  // namespace relief
