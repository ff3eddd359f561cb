// Scalars in the patch file: what comes back, and what of forged files is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_file_layout.h"
#include "common/patch_file/scalar_table.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bytes_of;
using test::ScratchFolder;
using test::slurp;
using test::spill;

PatchModel model_with_scalars() {
  PatchModel model = test::bumpy_model(3, 1);
  test::add_scalars(model);
  return model;
}

class Scalars : public testing::TestWithParam<PatchCodec> {
 protected:
  /// The bytes of a file of the model.
  std::string written(const PatchModel& model) {
    const auto status = write_patch_file(folder_ / "a.relief", model, {GetParam(), 0.5});
    EXPECT_TRUE(status) << status.error().message;
    return slurp(folder_ / "a.relief");
  }

  Result<PatchModel> read(const std::string& bytes) {
    spill(folder_ / "b.relief", bytes);
    RELIEF_TRY_ASSIGN(const auto file, PatchFile::open(folder_ / "b.relief"));
    Progress progress;
    return file.read_all(progress);
  }

  std::string failure(const std::string& bytes) {
    const auto model = read(bytes);
    return model ? std::string() : model.error().message;
  }

  ScratchFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Codecs, Scalars, testing::Values(PatchCodec::Fast, PatchCodec::Compact));

TEST_P(Scalars, ComeBackExactlyWhereThereAreSamples) {
  const PatchModel model = model_with_scalars();
  const auto back = read(written(model));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->scalars, model.scalars);
  ASSERT_EQ(back->patches.size(), model.patches.size());
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    ASSERT_EQ(back->patches[p].scalars.size(), 2U);
    for (std::size_t s = 0; s < 2; ++s) {
      const AttributeMap<std::uint16_t>& was = model.patches[p].scalars[s];
      const AttributeMap<std::uint16_t>& is = back->patches[p].scalars[s];
      ASSERT_EQ(is.texels.size(), was.texels.size());
      EXPECT_EQ(is.scale, was.scale);
      const std::vector<std::uint8_t> kept = kept_texels(model.patches[p], was.scale);
      for (std::size_t k = 0; k < kept.size(); ++k)
        ASSERT_EQ(is.texels[k], kept[k] != 0 ? was.texels[k] : kNoScalar) << p << " " << s;
    }
  }
}

TEST_P(Scalars, AreKnownWithoutReadingPatches) {
  const std::string bytes = written(model_with_scalars());
  const auto file = PatchFile::open(folder_ / "a.relief");
  ASSERT_TRUE(file);
  ASSERT_EQ(file->info().scalars.size(), 2U);
  EXPECT_EQ(file->info().scalars[1].name, "classification");
  EXPECT_GT(file->info().scalar_bytes, 0U);
  EXPECT_LT(file->info().scalar_bytes, bytes.size());
}

TEST_P(Scalars, CostNothingWithoutThem) {
  PatchModel model = test::bumpy_model(3, 1);
  const std::string bytes = written(model);
  test::add_scalars(model);
  model.scalars = {};
  for (Patch& patch : model.patches) patch.scalars = {};
  EXPECT_EQ(written(model), bytes);
}

TEST_P(Scalars, DamageIsFoundWhereverAFileEndsOrAByteIsWrong) {
  const std::string bytes = written(model_with_scalars());
  ASSERT_EQ(failure(bytes), "");
  for (std::size_t length = 0; length < bytes.size(); length += 3)
    ASSERT_NE(failure(bytes.substr(0, length)), "") << length;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x11);
    ASSERT_NE(failure(damaged), "") << at;
  }
}

/// The file with a changed index and header and the checksums made right.
std::string forged_scalars(const std::string& valid,
                           const std::function<void(FileHeader&, FileIndex&)>& forge) {
  const std::vector<std::byte> bytes = bytes_of(valid);
  FileHeader header = *parse_header(std::span(bytes).first(kHeaderBytes), bytes.size(), "");
  FileIndex index = *parse_index(std::span(bytes).subspan(header.index_offset), header, "");
  const std::string chunks = valid.substr(kHeaderBytes, header.index_offset - kHeaderBytes);
  forge(header, index);
  const std::vector<std::byte> index_bytes = write_index(index, header);
  header.index_checksum = crc32(index_bytes);
  header.file_bytes = header.index_offset + index_bytes.size();
  const auto text = [](const std::vector<std::byte>& some) {
    return std::string(reinterpret_cast<const char*>(some.data()), some.size());
  };
  return text(write_header(header)) + chunks + text(index_bytes);
}

TEST_P(Scalars, OfForgedFilesAreRefused) {
  const std::string valid = written(model_with_scalars());
  ASSERT_EQ(failure(forged_scalars(valid, [](FileHeader&, FileIndex&) {})), "");
  const auto scalar_of = [](FileIndex& index, std::size_t patch) -> ChunkRecord& {
    const PatchRecord& record = index.patches[patch];
    return index.chunks[record.first_chunk + record.chunk_count - 1];
  };
  for (const int scale : {0, 3, 65535}) {
    const std::string error = failure(forged_scalars(valid, [&](FileHeader&, FileIndex& index) {
      scalar_of(index, 1).scale = static_cast<std::uint16_t>(scale);
    }));
    EXPECT_NE(error.find("scalars"), std::string::npos) << scale << ": " << error;
  }
  // One patch has another number of scalars than the table.
  EXPECT_NE(failure(forged_scalars(valid,
                                   [&](FileHeader&, FileIndex& index) {
                                     scalar_of(index, 2).type = {'R', 'O', 'U', 'G'};
                                   })),
            "");
}

TEST(ScalarTable, RefusesWhatNoModelCanHave) {
  const PatchModel model = model_with_scalars();
  const std::vector<std::byte> valid = write_scalar_table(model.scalars);
  ASSERT_EQ(*parse_scalar_table(valid), model.scalars);
  for (std::size_t length = 0; length < valid.size(); ++length)
    EXPECT_FALSE(parse_scalar_table(std::span(valid).first(length))) << length;
  std::vector<std::byte> longer = valid;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(parse_scalar_table(longer));

  const auto fault = [&](const std::function<void(ScalarInfo&)>& change) {
    std::vector<ScalarInfo> scalars = model.scalars;
    change(scalars[0]);
    EXPECT_FALSE(parse_scalar_table(write_scalar_table(scalars)));
    return find_fault(scalars);
  };
  EXPECT_NE(fault([](ScalarInfo& s) { s.name.clear(); }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.name = "two words"; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.name = std::string(64, 'a'); }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.name = "classification"; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.offset = NAN; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.step = 0.0; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.step = 1e305; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.is_label = true; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.quantiles[3] = 0; }), "");
  EXPECT_NE(fault([](ScalarInfo& s) { s.quantiles.back() = kNoScalar; }), "");
  EXPECT_NE(find_fault(std::vector<ScalarInfo>(kMaxScalars + 1)), "");
}

/// A patch of version 1 may name chunks of any number, all of the same bytes.
TEST(ForgedScalars, AreNotDecodedMoreOftenThanTheTableSays) {
  const ScratchFolder folder;
  PatchModel model = model_with_scalars();
  ASSERT_TRUE(write_patch_file(folder / "a.relief", model));
  const std::string bytes =
      forged_scalars(slurp(folder / "a.relief"), [](FileHeader& h, FileIndex& index) {
        PatchRecord& last = index.patches.back();
        const ChunkRecord scalar = index.chunks.back();
        for (int k = 0; k < 1000; ++k) index.chunks.push_back(scalar);
        last.chunk_count += 1000;
        h.chunks += 1000;
      });
  spill(folder / "b.relief", bytes);
  const auto file = PatchFile::open(folder / "b.relief");
  ASSERT_TRUE(file) << file.error().message;
  const auto patch = file->read_patch(2);
  ASSERT_FALSE(patch);
  EXPECT_NE(patch.error().message.find("has more scalars than the 2 of the file"),
            std::string::npos)
      << patch.error().message;
}

TEST(WrongModel, HasPatchesWithOtherScalarsThanItsOwn) {
  const ScratchFolder folder;
  PatchModel model = model_with_scalars();
  model.patches[1].scalars.pop_back();
  const auto written = write_patch_file(folder / "a.relief", model);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("a patch has 1 scalars, the model 2"), std::string::npos);
  EXPECT_EQ(folder.count(), 0);
}

}  // namespace
}  // namespace relief
