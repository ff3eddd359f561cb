// Patch files that are damaged, truncated, forged or from the future: a sentence, never a crash,
// and never wrong data.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_file_layout.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bumpy_model;
using test::bytes_of;
using test::ScratchFolder;
using test::slurp;
using test::spill;

std::string text_of(const std::vector<std::byte>& bytes) {
  std::string text(bytes.size(), '\0');
  std::memcpy(text.data(), bytes.data(), bytes.size());
  return text;
}

/// Opens a file of these bytes and reads all of it: the message of the first failure without the
/// file's name, or nothing.
std::string read_failure(const ScratchFolder& folder, const std::string& bytes) {
  const std::filesystem::path path = folder / "read.relief";
  spill(path, bytes);
  const auto without_name = [&](const Error& error) {
    EXPECT_EQ(error.message.find(path.string() + ": "), 0U) << error.message;
    EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
    return error.message.substr(std::min(error.message.size(), path.string().size() + 2));
  };
  const auto file = PatchFile::open(path);
  if (!file) return without_name(file.error());
  Progress progress;
  const auto model = file->read_all(progress);
  return model ? std::string() : without_name(model.error());
}

std::string valid_bytes(const ScratchFolder& folder, std::uint32_t patches = 2,
                        PatchCodec codec = PatchCodec::Fast, bool seams = false) {
  PatchModel model = bumpy_model(patches, 1);
  if (seams) model.joined = {{0, patches}};
  EXPECT_TRUE(write_patch_file(folder / "valid.relief", model, {codec, 0.5}));
  return slurp(folder / "valid.relief");
}

/// The file with a changed header and index and all their checksums right again: what someone
/// forges.
std::string forged(const std::string& valid,
                   const std::function<void(FileHeader&, FileIndex&)>& forge) {
  const std::vector<std::byte> bytes = bytes_of(valid);
  FileHeader header = *parse_header(std::span(bytes).first(kHeaderBytes), bytes.size(), "");
  FileIndex index = *parse_index(std::span(bytes).subspan(header.index_offset), header, "");
  const std::string chunks = valid.substr(kHeaderBytes, header.index_offset - kHeaderBytes);
  forge(header, index);
  const std::vector<std::byte> index_bytes = write_index(index, header);
  header.index_checksum = crc32(index_bytes);
  return text_of(write_header(header)) + chunks + text_of(index_bytes);
}

/// Both codecs, each with its own index.
class DamagedPatchFile : public testing::TestWithParam<PatchCodec> {};
class ForgedChunks : public testing::TestWithParam<PatchCodec> {};
INSTANTIATE_TEST_SUITE_P(Codecs, DamagedPatchFile,
                         testing::Values(PatchCodec::Fast, PatchCodec::Compact));
INSTANTIATE_TEST_SUITE_P(Codecs, ForgedChunks,
                         testing::Values(PatchCodec::Fast, PatchCodec::Compact));

TEST_P(DamagedPatchFile, IsRefusedWhereverItEnds) {
  const ScratchFolder folder;
  for (const bool seams : {false, true}) {
    const std::string bytes = valid_bytes(folder, 2, GetParam(), seams);
    ASSERT_EQ(read_failure(folder, bytes), "");
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      ASSERT_NE(read_failure(folder, bytes.substr(0, length)), "") << length;
    }
    ASSERT_NE(read_failure(folder, bytes + '\0'), "");
  }
}

TEST_P(DamagedPatchFile, IsRefusedWhereverAByteIsWrong) {
  const ScratchFolder folder;
  for (const bool seams : {false, true}) {
    const std::string bytes = valid_bytes(folder, 2, GetParam(), seams);
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const int flip : {0x01, 0x80, 0xFF}) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ flip);
        ASSERT_NE(read_failure(folder, damaged), "") << "byte " << at << " flipped by " << flip;
      }
    }
  }
}

/// Decoders hold even where a checksum was made to fit: every byte of every chunk is tried.
TEST_P(ForgedChunks, DoNotCrashTheDecoders) {
  const ScratchFolder folder;
  const std::string valid = valid_bytes(folder, 2, GetParam());
  std::size_t refused = 0;
  std::size_t tried = 0;
  const auto try_one = [&](std::string bytes) {
    const std::string fixed = forged(bytes, [&](FileHeader&, FileIndex& index) {
      const std::vector<std::byte> all = bytes_of(bytes);
      for (ChunkRecord& chunk : index.chunks) {
        chunk.checksum = crc32(std::span(all).subspan(chunk.offset, chunk.size));
      }
    });
    ++tried;
    if (!read_failure(folder, fixed).empty()) ++refused;
  };
  const auto index_at = [&] {
    const std::vector<std::byte> bytes = bytes_of(valid);
    return parse_header(std::span(bytes).first(kHeaderBytes), bytes.size(), "")->index_offset;
  }();
  for (std::size_t at = kHeaderBytes; at < index_at; ++at) {
    for (const int flip : {0x01, 0x7F, 0xFF}) {
      std::string bytes = valid;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      try_one(bytes);
    }
  }
  EXPECT_GT(tried, 1000U);
  EXPECT_GT(refused, tried / 10);  // sizes, zstd headers, runs and ranges are found wrong
}

TEST(ForgedPatchFile, CannotAskForMuchMemoryOrForeignBytes) {
  const ScratchFolder folder;
  const std::string valid = valid_bytes(folder);
  const auto failure = [&](const std::function<void(FileHeader&, FileIndex&)>& forge) {
    return read_failure(folder, forged(valid, forge));
  };
  ASSERT_EQ(failure([](FileHeader&, FileIndex&) {}), "");

  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.patches = 0xFFFFFFFF; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.chunks = 0xFFFFFFFF; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.index_offset = ~std::uint64_t{0}; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.index_offset = 0; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.file_bytes += 1; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.samples += 1; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.spacing = std::nan(""); }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.bounds.min.z = -INFINITY; }), "");
  EXPECT_NE(failure([](FileHeader& h, FileIndex&) { h.bounding_radius = -1.0; }), "");

  const auto patch_failure = [&](const std::function<void(PatchSummary&)>& forge) {
    return failure([&](FileHeader&, FileIndex& index) { forge(index.patches[1].summary); });
  };
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.origin.x = std::nan(""); }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.axes[2] *= 1.0001; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.spacing = INFINITY; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.spacing = 5e-324; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.height_step = 0.0; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.width = 0; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.width += 1; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.height = kMaxPatchSide + 1; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.height = 0xFFFFFFFF; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.samples -= 1; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { std::swap(p.min_height, p.max_height); }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.max_height = 65535; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.max_height += 1; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.min_height -= 1; }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.cone_cosine = std::nanf(""); }), "");
  EXPECT_NE(patch_failure([](PatchSummary& p) { p.height_step *= 1e12; }), "");

  const auto chunk_failure = [&](const std::function<void(ChunkRecord&)>& forge) {
    return failure([&](FileHeader&, FileIndex& index) { forge(index.chunks[4]); });
  };
  EXPECT_NE(chunk_failure([](ChunkRecord& c) { c.offset = 0; }), "");
  EXPECT_NE(chunk_failure([](ChunkRecord& c) { c.offset = ~std::uint64_t{0}; }), "");
  EXPECT_NE(chunk_failure([](ChunkRecord& c) { c.size = 0xFFFFFFFF; }), "");
  EXPECT_NE(chunk_failure([](ChunkRecord& c) {
              c.size = 0;
              c.checksum = 0;
            }),
            "");
  EXPECT_NE(chunk_failure([](ChunkRecord& c) { c.scale = 0; }), "");
  EXPECT_NE(chunk_failure([](ChunkRecord& c) { c.scale = 2; }), "");
  EXPECT_NE(chunk_failure([](ChunkRecord& c) { c.scale = 65535; }), "");
  EXPECT_NE(failure([](FileHeader&, FileIndex& i) { i.patches[1].first_chunk = 0xFFFFFFFF; }), "");
  EXPECT_NE(failure([](FileHeader&, FileIndex& i) { i.patches[1].chunk_count = 4; }), "");
  EXPECT_EQ(failure([](FileHeader&, FileIndex& i) { i.patches[1].chunk_count = 0; }),
            "patch 1 has no heights; the file is damaged");
}

/// Many patches of the largest size that all lie in the same few bytes.
TEST(ForgedPatchFile, CannotAskForMoreThanTheMachineHas) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(1);
  Patch& patch = model.patches[0];
  patch.width = patch.height = 256;
  patch.heights.assign(std::size_t{256} * 256, 5);
  patch.normals = {};
  ASSERT_TRUE(write_patch_file(folder / "valid.relief", model));
  const std::string bytes =
      forged(slurp(folder / "valid.relief"), [](FileHeader& header, FileIndex& index) {
        index.patches[0].summary.width = kMaxPatchSide;
        index.patches[0].summary.height = kMaxPatchSide;
        index.patches[0].summary.samples = kMaxPatchSide * kMaxPatchSide;
        index.patches.resize(16384, index.patches[0]);
        header.patches = 16384;
        header.samples = 16384 * std::uint64_t{index.patches[0].summary.samples};
        header.file_bytes += 16383 * kPatchRecordBytes;
      });
  EXPECT_EQ(read_failure(folder, bytes).find("the patches take 16777216 MB of memory"), 0U)
      << read_failure(folder, bytes);
}

/// Maps of 16129 x 16129 texels a patch, which count without being there.
TEST(ForgedPatchFile, CannotAskForMapsBeyondTheMachinesMemory) {
  const ScratchFolder folder;
  PatchModel model = bumpy_model(1, 1);
  model.patches[0] = test::bumpy_patch({.width = 257, .height = 257, .normals = 0, .colours = 1});
  ASSERT_TRUE(write_patch_file(folder / "valid.relief", model));
  const std::string bytes =
      forged(slurp(folder / "valid.relief"), [](FileHeader& header, FileIndex& index) {
        index.chunks[1].scale = 63;
        index.patches.resize(16384, index.patches[0]);
        header.patches = 16384;
        header.samples = 16384 * std::uint64_t{index.patches[0].summary.samples};
        header.file_bytes += 16383 * kPatchRecordBytes;
      });
  EXPECT_EQ(read_failure(folder, bytes).find("the patches take 12198"), 0U)
      << read_failure(folder, bytes);
}

TEST(ForeignPatchFile, IsNamedInOneSentence) {
  const ScratchFolder folder;
  std::string bytes = valid_bytes(folder);
  bytes[8] = 7;
  EXPECT_EQ(read_failure(folder, bytes),
            "patch file version 7; this program reads versions 1 to 3; get a newer relief");
  // A newer version may have any header behind its number.
  EXPECT_EQ(read_failure(folder, bytes.substr(0, 12)),
            "patch file version 7; this program reads versions 1 to 3; get a newer relief");
  EXPECT_EQ(read_failure(folder, "ply\nformat ascii 1.0\n"), "is not a .relief patch file");
  EXPECT_EQ(read_failure(folder, ""), "the file is empty");
  EXPECT_EQ(read_failure(folder, valid_bytes(folder).substr(0, 40)),
            "the file is truncated within its header");
}

TEST(ForeignPatchFile, MayHaveChunksThatAreNotKnownYet) {
  const ScratchFolder folder;
  const std::string bytes = valid_bytes(folder);
  // A colour chunk of another type in an unheard-of codec: passed over.
  const std::string other = forged(bytes, [](FileHeader&, FileIndex& index) {
    ASSERT_EQ(index.chunks[2].type, kColoursChunk);
    index.chunks[2].type = {'R', 'O', 'U', 'G'};
    index.chunks[2].codec = 999;
  });
  spill(folder / "other.relief", other);
  const auto file = PatchFile::open(folder / "other.relief");
  ASSERT_TRUE(file) << file.error().message;
  const auto patch = file->read_patch(0);
  ASSERT_TRUE(patch) << patch.error().message;
  EXPECT_TRUE(patch->colours.empty());
  EXPECT_FALSE(patch->normals.empty());
  // A known type in an unknown codec: refused.
  EXPECT_EQ(
      read_failure(folder,
                   forged(bytes, [](FileHeader&, FileIndex& index) { index.chunks[3].codec = 3; })),
      "patch 1: its heights are in codec 3, which this program does not know; get a newer "
      "relief");
}

TEST(PatchFile, ReadsOnePatchWithoutTheOthers) {
  const ScratchFolder folder;
  const std::string bytes = valid_bytes(folder, 5);
  const PatchModel model = bumpy_model(5, 1);
  const std::vector<std::byte> all = bytes_of(bytes);
  const FileHeader header = *parse_header(std::span(all).first(kHeaderBytes), all.size(), "");
  const FileIndex index = *parse_index(std::span(all).subspan(header.index_offset), header, "");
  for (std::size_t p = 0; p < 5; ++p) {
    std::string damaged = bytes;
    const auto own = [&](std::size_t chunk) {
      return chunk >= index.patches[p].first_chunk &&
             chunk < index.patches[p].first_chunk + index.patches[p].chunk_count;
    };
    for (std::size_t c = 0; c < index.chunks.size(); ++c) {
      if (own(c)) continue;
      std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(index.chunks[c].offset),
                  index.chunks[c].size, 'x');
    }
    spill(folder / "damaged.relief", damaged);
    const auto file = PatchFile::open(folder / "damaged.relief");
    ASSERT_TRUE(file) << file.error().message;
    const auto patch = file->read_patch(p);
    ASSERT_TRUE(patch) << patch.error().message;
    EXPECT_EQ(patch->heights, model.patches[p].heights);
    const auto other = file->read_patch((p + 1) % 5);
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().message.find("checksum of its heights"), std::string::npos);
    // Of many damaged patches the first is named, whatever the threads do.
    Progress progress;
    const auto whole = file->read_all(progress);
    ASSERT_FALSE(whole);
    EXPECT_NE(whole.error().message.find(p == 0 ? "patch 1:" : "patch 0:"), std::string::npos);
  }
}

}  // namespace
}  // namespace relief
