// A file of each version, written when the version was made, decodes to the same values for ever.
// It is not to be made again: a change that breaks this test breaks everybody's files.
#include <gtest/gtest.h>

#include "tests/common/describe_model.h"
#include "tests/common/read_whole.h"
#include "tests/common/sample_models.h"

namespace relief {
namespace {

class FrozenPatchFile : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Versions, FrozenPatchFile, testing::Values("version1", "version2"));

TEST_P(FrozenPatchFile, DecodesAsItAlwaysDid) {
  const std::filesystem::path file = std::filesystem::path(RELIEF_TEST_DATA) / GetParam();
  const PatchModel model = test::read_whole(file.string() + ".relief");
  EXPECT_FALSE(model.is_closed);  // version1 is older than the flag: not known
  EXPECT_EQ(test::describe(model), test::slurp(file.string() + ".txt"));
}

}  // namespace
}  // namespace relief
