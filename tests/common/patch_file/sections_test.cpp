// Which bytes of a patch file are read: those of the maps that are asked for.
#include <gtest/gtest.h>

#include <string>

#include "common/patch_file/patch_file.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

class Sections : public testing::TestWithParam<PatchCodec> {
 protected:
  void SetUp() override {
    PatchModel model = test::bumpy_model(3, 2);
    test::add_scalars(model);
    PatchFileOptions options;
    options.codec = GetParam();
    ASSERT_TRUE(write_patch_file(path(), model, options));
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_ / "a.relief"; }

  /// Reads all patches, which must succeed.
  SectionBytes read(const PatchSections& sections, PatchModel& model) const {
    Progress silent;
    const auto file = PatchFile::open(path());
    EXPECT_TRUE(file) << file.error().message;
    auto all = file->read_all(silent, sections);
    EXPECT_TRUE(all) << all.error().message;
    if (all) model = *std::move(all);
    return file->bytes_read();
  }

  test::ScratchFolder folder_;
};

TEST_P(Sections, AllAreReadByDefault) {
  PatchModel model;
  const SectionBytes read_bytes = read({}, model);
  const PatchFileInfo info = PatchFile::open(path())->info();
  EXPECT_EQ(read_bytes, (SectionBytes{info.height_bytes, info.normal_bytes, info.colour_bytes,
                                      info.scalar_bytes}));
  EXPECT_GT(read_bytes.normals, 0U);
  EXPECT_GT(read_bytes.colours, 0U);
  EXPECT_GT(read_bytes.scalars, 0U);
  EXPECT_TRUE(model.has_colours);
  EXPECT_EQ(model.scalars.size(), 2U);
}

TEST_P(Sections, OfMapsThatAreLeftOutNoByteIsRead) {
  PatchModel whole;
  const SectionBytes all = read({}, whole);
  PatchModel model;
  EXPECT_EQ(read({false, true, true}, model),
            (SectionBytes{all.heights, 0, all.colours, all.scalars}));
  EXPECT_EQ(read({true, false, false}, model), (SectionBytes{all.heights, all.normals, 0, 0}));
  EXPECT_FALSE(model.has_colours);
  EXPECT_TRUE(model.scalars.empty());
  EXPECT_EQ(read({false, false, false}, model), (SectionBytes{all.heights, 0, 0, 0}));
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    EXPECT_EQ(model.patches[p].heights, whole.patches[p].heights);
    EXPECT_TRUE(model.patches[p].normals.empty());
    EXPECT_TRUE(model.patches[p].colours.empty());
    EXPECT_TRUE(model.patches[p].scalars.empty());
  }
}

/// What is not read can't be wrong: the strongest proof that it is not.
TEST_P(Sections, DamageToMapsThatAreLeftOutIsNotSeen) {
  std::string bytes = test::slurp(path());
  Progress silent;
  bool some_normals = false;
  for (std::size_t at = 128; at < bytes.size(); at += 31) {
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    test::spill(path(), bytes);
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    const auto file = PatchFile::open(path());
    if (!file) continue;  // the index
    const auto all = file->read_all(silent);
    if (all || all.error().message.find("its normals") == std::string::npos) continue;
    some_normals = true;
    EXPECT_TRUE(file->read_all(silent, {false, true, true})) << "byte " << at;
  }
  EXPECT_TRUE(some_normals);
}

INSTANTIATE_TEST_SUITE_P(Codecs, Sections, testing::Values(PatchCodec::Fast, PatchCodec::Compact),
                         [](const auto& codec) {
                           return codec.param == PatchCodec::Fast ? "Fast" : "Compact";
                         });

}  // namespace
}  // namespace relief
