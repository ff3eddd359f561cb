#include "viewer/choices/path_completion.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

class PathCompletion : public testing::Test {
 protected:
  PathCompletion() {
    fs::create_directories(folder_ / "maps");
    fs::create_directories(folder_ / ".hidden");
    for (const char* name : {"studio.exr", "sunset.HDR", "sun.txt", "maps/city.exr"})
      std::ofstream(folder_ / name) << "x";
  }

  /// Without the folder that all of them begin with.
  [[nodiscard]] std::vector<std::string> complete(const std::string& typed,
                                                  std::size_t most = kMostCompletions) const {
    const std::string before = folder_.string() + "/";
    std::vector<std::string> found = complete_path(
        before + typed,
        [](const fs::path& p) {
          return has_extension(p, {".exr", ".hdr"});
        },
        most);
    for (std::string& text : found) {
      EXPECT_TRUE(text.starts_with(before)) << text;
      text.erase(0, before.size());
    }
    return found;
  }

  const test::ScratchFolder scratch_;  // ctest runs several of these tests at once
  const fs::path& folder_ = scratch_.path();
};

using Texts = std::vector<std::string>;

TEST_F(PathCompletion, ListsFoldersAndFilesOfTheRightKind) {
  EXPECT_EQ(complete(""), (Texts{"maps/", "studio.exr", "sunset.HDR"}));
  EXPECT_EQ(complete("su"), Texts{"sunset.HDR"});
  EXPECT_EQ(complete("maps/"), Texts{"maps/city.exr"});
  EXPECT_EQ(complete("nothing"), Texts());
  EXPECT_EQ(complete("no/such/folder/"), Texts());
  EXPECT_EQ(complete("", 2), (Texts{"maps/", "studio.exr"}));
}

TEST_F(PathCompletion, ListsHiddenFoldersOnlyIfTheyAreAskedFor) {
  EXPECT_EQ(complete("."), Texts{".hidden/"});
}

TEST_F(PathCompletion, GoesOnAsFarAsAllAgree) {
  EXPECT_EQ(common_start({"studio.exr", "sunset.HDR"}), "s");
  EXPECT_EQ(common_start({"sun", "sunset"}), "sun");
  EXPECT_EQ(common_start({"only.exr"}), "only.exr");
  EXPECT_EQ(common_start({}), "");
}

TEST_F(PathCompletion, KnowsTheUsersHome) {
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') GTEST_SKIP() << "there is no home";
  EXPECT_EQ(typed_path("~/a.exr"), fs::path(std::string(home) + "/a.exr"));
  EXPECT_EQ(typed_path("~other/a.exr"), fs::path("~other/a.exr"));
  EXPECT_EQ(typed_path("a~"), fs::path("a~"));
}

}  // namespace
}  // namespace relief
