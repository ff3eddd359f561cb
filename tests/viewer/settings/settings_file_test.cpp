#include "viewer/settings/settings_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace relief {
namespace {

namespace fs = std::filesystem;

class SettingsFile : public testing::Test {
 protected:
  SettingsFile() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~SettingsFile() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path file_ = folder_ / "config" / "relief" / "viewer.json";
};

TEST(SettingsPath, IsWhereTheXdgSpecificationSays) {
  EXPECT_EQ(settings_path("/conf", "/home/a"), "/conf/relief/viewer.json");
  EXPECT_EQ(settings_path(nullptr, "/home/a"), "/home/a/.config/relief/viewer.json");
  EXPECT_EQ(settings_path("", "/home/a"), "/home/a/.config/relief/viewer.json");
  EXPECT_EQ(settings_path("relative", "/home/a"), "/home/a/.config/relief/viewer.json");
  EXPECT_EQ(settings_path(nullptr, nullptr), std::nullopt);
  EXPECT_EQ(settings_path(nullptr, ""), std::nullopt);
}

TEST_F(SettingsFile, IsReadAsItWasWritten) {
  Preferences some;
  some.target_ms = 50.0;
  some.recent_files = {"/scans/dragon.relief"};
  const Status saved = save_preferences(file_, some);
  ASSERT_TRUE(saved) << saved.error().message;
  const auto loaded = load_preferences(file_);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(*loaded, some);
  // Nothing is left beside it.
  EXPECT_EQ(std::distance(fs::directory_iterator(file_.parent_path()), fs::directory_iterator()),
            1);
}

TEST_F(SettingsFile, IsNotNeeded) {
  const auto loaded = load_preferences(file_);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(*loaded, Preferences());
}

TEST_F(SettingsFile, IsRefusedIfItIsNone) {
  fs::create_directories(file_);  // a folder of that name
  EXPECT_FALSE(load_preferences(file_));
  EXPECT_FALSE(save_preferences(file_, {}));
  fs::remove(file_);
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_FALSE(load_preferences(file_));  // and does not wait for a writer
  fs::remove(file_);
  std::ofstream(file_) << "";
  EXPECT_FALSE(load_preferences(file_));
  std::ofstream(file_) << std::string(std::size_t{2} << 20U, ' ');
  const auto loaded = load_preferences(file_);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().message, file_.string() + ": has 2097152 bytes, too many for settings");
}

TEST_F(SettingsFile, IsNotWrittenWhereNoFolderCanBe) {
  std::ofstream(folder_ / "config") << "a file in the way";
  EXPECT_FALSE(save_preferences(file_, {}));
}

}  // namespace
}  // namespace relief
