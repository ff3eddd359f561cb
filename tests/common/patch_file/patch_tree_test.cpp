#include "common/patch_file/patch_tree.h"

#include <gtest/gtest.h>

#include <functional>

#include "common/io/file.h"
#include "common/patch_file/patch_tree_layout.h"
#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::read_whole;
using test::ScratchFolder;
using test::slurp;
using test::spill;

/// The patches [first, last) of a model, with its bounds and `scale` times its spacing.
PatchModel part_of(const PatchModel& model, std::size_t first, std::size_t last,
                   double scale = 1.0) {
  PatchModel part = model;
  part.patches.assign(model.patches.begin() + static_cast<std::ptrdiff_t>(first),
                      model.patches.begin() + static_cast<std::ptrdiff_t>(last));
  part.spacing *= scale;
  for (Patch& patch : part.patches) patch.spacing *= scale;
  return part;
}

/// Two tiles, the second without patches, under one of twice the spacing. `seams`: the patches of
/// each meet.
std::vector<TreePart> write_parts(const ScratchFolder& folder, const PatchModel& model,
                                  PatchCodec codec, bool seams = false) {
  const PatchFileOptions options{codec, 0.5};
  const std::size_t count = model.patches.size();
  const auto write = [&](const char* name, PatchModel part) {
    if (seams) part.joined = {{0, static_cast<std::uint32_t>(part.patches.size())}};
    EXPECT_TRUE(write_patch_file(folder / name, part, options));
  };
  write("top", part_of(model, 0, 1, 2.0));
  write("a", part_of(model, 1, count));
  write("b", part_of(model, 0, 0));
  return {{folder / "top", 1, kNoTile}, {folder / "a", 0, 0}, {folder / "b", 0, 0}};
}

void expect_same(const std::vector<Patch>& a, const std::vector<Patch>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    SCOPED_TRACE(p);
    EXPECT_EQ(a[p].origin, b[p].origin);
    EXPECT_EQ(a[p].axes, b[p].axes);
    EXPECT_EQ(a[p].spacing, b[p].spacing);
    EXPECT_EQ(a[p].height_step, b[p].height_step);
    EXPECT_EQ(a[p].heights, b[p].heights);
    EXPECT_EQ(a[p].normals.texels, b[p].normals.texels);
    EXPECT_EQ(a[p].colours.texels, b[p].colours.texels);
  }
}

/// All patches of a tile, or what speaks against them.
Result<PatchModel> read_tile(const PatchTree& tree, std::uint32_t tile) {
  const auto file = tree.open_tile(tile);
  if (!file) return file.error();
  Progress progress;
  return file->read_all(progress);
}

/// The message of the first failure in reading a file and all of its tiles, or nothing.
std::string tree_read_failure(const ScratchFolder& folder, const std::string& bytes) {
  spill(folder / "read", bytes);
  const auto file = PatchFile::open(folder / "read");
  if (!file) return file.error().message;
  const auto tree = PatchTree::open(folder / "read");
  if (!tree) return tree.error().message;
  for (std::uint32_t t = 0; t < tree->tiles().size(); ++t) {
    const auto tile = read_tile(*tree, t);
    if (!tile) return tile.error().message;
  }
  return {};
}

class PatchTreeOf : public testing::TestWithParam<PatchCodec> {};
INSTANTIATE_TEST_SUITE_P(Codecs, PatchTreeOf,
                         testing::Values(PatchCodec::Fast, PatchCodec::Compact));

TEST_P(PatchTreeOf, HasTheTilesThatWereWritten) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5, 2);
  const std::vector<TreePart> parts = write_parts(folder, model, GetParam());
  ASSERT_TRUE(write_patch_tree(folder / "tree", parts, model));
  const auto tree = PatchTree::open(folder / "tree");
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->extent().spacing, model.spacing);
  EXPECT_EQ(tree->extent().bounds.max, model.bounds.max);
  EXPECT_EQ(tree->extent().bounding_radius, model.bounding_radius);
  ASSERT_EQ(tree->tiles().size(), parts.size());
  for (std::uint32_t t = 0; t < parts.size(); ++t) {
    SCOPED_TRACE(t);
    const TreeTile& tile = tree->tiles()[t];
    const PatchModel expected = read_whole(parts[t].path);
    EXPECT_EQ(tile.level, parts[t].level);
    EXPECT_EQ(tile.parent, parts[t].parent);
    EXPECT_EQ(tile.spacing, expected.spacing);
    EXPECT_EQ(tile.patches, expected.patches.size());
    EXPECT_EQ(tile.samples, count_samples(expected));
    const auto read = read_tile(*tree, t);
    ASSERT_TRUE(read) << read.error().message;
    expect_same(read->patches, expected.patches);
    for_each_position(expected.patches, [&](glm::dvec3 position) {
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        EXPECT_GE(position[axis], tile.box.min[axis]);
        EXPECT_LE(position[axis], tile.box.max[axis]);
      }
    });
  }
  EXPECT_TRUE(tree->tiles().back().box.empty());
}

TEST_P(PatchTreeOf, IsAFileOfTheModelsOwnPatches) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5, 2);
  const std::vector<TreePart> parts = write_parts(folder, model, GetParam());
  ASSERT_TRUE(write_patch_tree(folder / "tree", parts, model));
  const auto file = PatchFile::open(folder / "tree");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->info().version, 3U);
  EXPECT_EQ(file->info().codec, GetParam() == PatchCodec::Fast ? "fast" : "compact");
  EXPECT_EQ(file->info().patches, 4U);
  EXPECT_EQ(file->info().file_bytes, std::filesystem::file_size(folder / "tree"));
  const PatchModel whole = read_whole(folder / "tree");
  expect_same(whole.patches, read_whole(folder / "a").patches);
  EXPECT_TRUE(whole.has_colours);
}

TEST_P(PatchTreeOf, HasARunOfJoinedPatchesForEachTile) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(5);
  const auto write = [&](const char* name, std::size_t first, std::size_t last, bool seams) {
    PatchModel part = part_of(model, first, last);
    if (seams) part.joined = {{0, static_cast<std::uint32_t>(part.patches.size())}};
    EXPECT_TRUE(write_patch_file(folder / name, part, {GetParam(), 0.5}));
    return TreePart{folder / name};
  };
  const std::vector<TreePart> parts{write("a", 0, 2, true), write("b", 0, 0, true),
                                    write("c", 2, 3, false), write("d", 3, 5, true)};
  ASSERT_TRUE(write_patch_tree(folder / "tree", parts, model));
  const PatchModel whole = read_whole(folder / "tree");
  ASSERT_EQ(whole.joined.size(), 2U);
  EXPECT_EQ(whole.joined[0].first, 0U);
  EXPECT_EQ(whole.joined[0].count, 2U);
  EXPECT_EQ(whole.joined[1].first, 3U);
  EXPECT_EQ(whole.joined[1].count, 2U);
  EXPECT_EQ(run_of(whole, 1), &whole.joined[0]);
  EXPECT_EQ(run_of(whole, 2), nullptr);
  EXPECT_EQ(run_of(whole, 4), &whole.joined[1]);
  EXPECT_TRUE(PatchFile::open(folder / "tree")->info().is_joined);
  const auto tree = PatchTree::open(folder / "tree");
  EXPECT_EQ(tree->open_tile(0)->joined().size(), 1U);
  EXPECT_TRUE(tree->open_tile(2)->joined().empty());
  // Normals beyond borders are those of the tile alone.
  expect_same(read_tile(*tree, 3)->patches, {whole.patches.begin() + 3, whole.patches.end()});
}

TEST(PatchTree, AFileWithoutTilesIsOne) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5);
  ASSERT_TRUE(write_patch_file(folder / "a", model));
  const auto tree = PatchTree::open(folder / "a");
  ASSERT_TRUE(tree) << tree.error().message;
  ASSERT_EQ(tree->tiles().size(), 1U);
  EXPECT_EQ(tree->tiles().front().level, 0U);
  EXPECT_EQ(tree->tiles().front().samples, count_samples(model));
  EXPECT_FALSE(tree->tiles().front().box.empty());
  const auto read = read_tile(*tree, 0);
  ASSERT_TRUE(read) << read.error().message;
  expect_same(read->patches, read_whole(folder / "a").patches);
}

/// The bytes of a small tree.
std::string valid_tree(const ScratchFolder& folder, PatchCodec codec, bool seams = false) {
  const PatchModel model = bumpy_model(2, 1);
  EXPECT_TRUE(write_patch_tree(folder / "valid", write_parts(folder, model, codec, seams), model));
  return slurp(folder / "valid");
}

TEST(PatchTree, HasTheScalarsOfItsTiles) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(5);
  model.scalars = {{"intensity", false, 3.0, 0.5, {}}};
  for (Patch& patch : model.patches) {
    const std::size_t nodes = std::size_t{patch.width} * patch.height;
    patch.scalars = {{patch.width, patch.height, 1, std::vector<std::uint16_t>(nodes, 7)}};
  }
  const std::vector<TreePart> parts = write_parts(folder, model, PatchCodec::Fast);
  ASSERT_TRUE(write_patch_tree(folder / "tree", parts, model));
  const auto tree = PatchTree::open(folder / "tree");
  ASSERT_TRUE(tree) << tree.error().message;
  EXPECT_EQ(tree->extent().scalars, model.scalars);
  const auto tile = read_tile(*tree, 1);
  ASSERT_TRUE(tile) << tile.error().message;
  EXPECT_EQ(texel_at(tile->patches[0].scalars[0], tile->patches[0].width / 2,
                     tile->patches[0].height / 2),
            7);

  // Painting relies on it.
  PatchModel other = model;
  other.scalars[0].name = "time";
  ASSERT_TRUE(write_patch_tree(folder / "forged", parts, other));
  const auto forged = PatchTree::open(folder / "forged");
  ASSERT_TRUE(forged);
  const auto refused = read_tile(*forged, 1);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("are not those of the model"), std::string::npos);
}

TEST_P(PatchTreeOf, IsRefusedWhereverItEnds) {
  const ScratchFolder folder;
  for (const bool seams : {false, true}) {
    const std::string bytes = valid_tree(folder, GetParam(), seams);
    ASSERT_EQ(tree_read_failure(folder, bytes), "");
    for (std::size_t length = 0; length < bytes.size(); ++length)
      ASSERT_NE(tree_read_failure(folder, bytes.substr(0, length)), "") << length;
    ASSERT_NE(tree_read_failure(folder, bytes + '\0'), "");
  }
}

TEST_P(PatchTreeOf, IsRefusedWhereverAByteIsWrong) {
  const ScratchFolder folder;
  for (const bool seams : {false, true}) {
    const std::string bytes = valid_tree(folder, GetParam(), seams);
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const int flip : {0x01, 0x80, 0xFF}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        ASSERT_NE(tree_read_failure(folder, damaged), "")
            << "byte " << at << " flipped by " << flip;
      }
    }
  }
}

/// The failure of a tree whose list of tiles somebody has forged, checksums and all.
std::string forged_failure(const std::function<void(FileHeader&, std::vector<TreeTile>&)>& forge) {
  const ScratchFolder folder;
  const std::string valid = valid_tree(folder, PatchCodec::Fast);
  const auto file = RandomAccessFile::open(folder / "valid");
  TreeLayout layout = *read_tree_layout(*file, "");
  const std::string tiles = valid.substr(kHeaderBytes, layout.header.index_offset - kHeaderBytes);
  forge(layout.header, layout.tiles);
  const std::vector<std::byte> index = write_tree_index(layout.tiles);
  layout.header.index_checksum = crc32(index);
  const std::vector<std::byte> header = write_header(layout.header);
  const auto text_of = [](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  return tree_read_failure(folder, text_of(header) + tiles + text_of(index));
}

TEST(ForgedPatchTree, IsRefused) {
  const auto expect = [](std::string_view clause,
                         const std::function<void(FileHeader&, std::vector<TreeTile>&)>& forge) {
    const std::string failure = forged_failure(forge);
    EXPECT_NE(failure.find(clause), std::string::npos) << failure << " is not " << clause;
  };
  EXPECT_EQ(forged_failure([](auto&, auto&) {}), "");
  expect("its parent does not come before", [](auto&, auto& tiles) { tiles[0].parent = 0; });
  expect("its parent does not come before", [](auto&, auto& tiles) { tiles[1].parent = 2; });
  expect("its parent is not of the level above", [](auto&, auto& tiles) { tiles[1].level = 1; });
  expect("its level is 64", [](auto&, auto& tiles) { tiles[0].level = 64; });
  expect("it has 18446744073709551615 bytes",
         [](auto&, auto& tiles) { tiles[1].bytes = UINT64_MAX; });
  expect("it has 127 bytes", [](auto&, auto& tiles) { tiles[2].bytes = 127; });
  expect("tiles end at byte", [](auto&, auto& tiles) { --tiles[1].bytes; });
  expect("but the header states", [](auto&, auto& tiles) { ++tiles[1].samples; });
  expect("differs from the list of tiles", [](auto&, auto& tiles) { ++tiles[0].samples; });
  expect("differs from the list of tiles", [](auto&, auto& tiles) { tiles[1].spacing *= 2.0; });
  expect("differs from the list of tiles", [](auto&, auto& tiles) { tiles[1].box.max.x -= 1.0; });
  expect("differs from the list of tiles", [](auto&, auto& tiles) { tiles[1].box = Bounds{}; });
  expect("does not fit at byte", [](auto& header, auto&) { header.chunks = UINT32_MAX; });
  expect("its bounds are not finite",
         [](auto&, auto& tiles) { tiles[1].box.max.x = std::numeric_limits<double>::infinity(); });
}

TEST(ForgedPatchTree, HasNoTilesOfItsOwnInItsTiles) {
  const ScratchFolder folder;
  const std::string inner = valid_tree(folder, PatchCodec::Fast);
  FileHeader header;
  header.version = kTreeVersion;
  header.chunks = 1;
  header.index_offset = kHeaderBytes + inner.size();
  TreeTile tile;
  tile.bytes = inner.size();
  const std::vector<std::byte> index = write_tree_index({&tile, 1});
  header.file_bytes = header.index_offset + index.size();
  header.index_checksum = crc32(index);
  const auto text_of = [](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const std::string failure =
      tree_read_failure(folder, text_of(write_header(header)) + inner + text_of(index));
  EXPECT_NE(failure.find("tiles have tiles of their own"), std::string::npos) << failure;
}

TEST(PatchTree, DamagedPartsAreRefusedAndNothingIsLeft) {
  const ScratchFolder folder;
  const PatchModel model = bumpy_model(5);
  ASSERT_TRUE(write_patch_file(folder / "good", model));
  const std::string good = slurp(folder / "good");
  spill(folder / "cut", good.substr(0, good.size() / 2));
  EXPECT_FALSE(write_patch_tree(folder / "tree", {{folder / "good"}, {folder / "cut"}}, model));
  EXPECT_FALSE(std::filesystem::exists(folder / "tree"));
  EXPECT_EQ(folder.count(), 2);
}

}  // namespace
}  // namespace relief
