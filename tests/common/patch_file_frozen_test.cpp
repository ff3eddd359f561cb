// A file of each version, written when the version was made, decodes to the same values for ever.
// It is not to be made again: a change that breaks this test breaks everybody's files.
#include <gtest/gtest.h>

#include "common/patch_file.h"
#include "tests/common/describe_model.h"
#include "tests/common/sample_models.h"

namespace relief {
namespace {

TEST(FrozenPatchFile, Version1DecodesAsItAlwaysDid) {
  const std::filesystem::path data = RELIEF_TEST_DATA;
  const auto file = PatchFile::open(data / "version1.relief");
  ASSERT_TRUE(file) << file.error().message;
  Progress progress;
  const auto model = file->read_all(progress);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_FALSE(model->is_closed);  // older than the flag: not known
  EXPECT_EQ(test::describe(*model), test::slurp(data / "version1.txt"));
}

TEST(FrozenPatchFile, Version2DecodesAsItAlwaysDid) {
  const std::filesystem::path data = RELIEF_TEST_DATA;
  const auto file = PatchFile::open(data / "version2.relief");
  ASSERT_TRUE(file) << file.error().message;
  Progress progress;
  const auto model = file->read_all(progress);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(test::describe(*model), test::slurp(data / "version2.txt"));
}

}  // namespace
}  // namespace relief
