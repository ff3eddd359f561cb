// Files: either the whole of it is there or nothing has changed, and one sentence says why.
#include "common/io/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstring>

#include "common/image/image_io.h"
#include "common/patch_file/patch_file.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::bytes_of;
using test::ScratchFolder;
using test::slurp;
using test::spill;

/// No file of this process grows beyond `bytes` while it lives: what a full disk is like, without
/// one. The kernel answers EFBIG where a full disk answers ENOSPC.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(ReadFile, ReadsAllBytes) {
  const ScratchFolder folder;
  spill(folder / "a", std::string("a\0b\xff", 4));
  const auto bytes = read_file(folder / "a");
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, bytes_of(std::string("a\0b\xff", 4)));
}

TEST(ReadFile, SaysWhatIsWrong) {
  const ScratchFolder folder;
  const auto message = [](const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    return bytes ? std::string() : bytes.error().message;
  };
  const std::string none = (folder / "none").string();
  EXPECT_EQ(message(none), none + ": cannot be opened: no such file or directory");
  EXPECT_EQ(message(folder.path()), folder.path().string() + ": is a directory, not a file");
  spill(folder / "empty", "");
  EXPECT_EQ(message(folder / "empty"), (folder / "empty").string() + ": the file is empty");
  EXPECT_EQ(message("/dev/null"), "/dev/null: is not a regular file");
  // A pipe that nobody writes to must not be waited for.
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(message(folder / "pipe"), (folder / "pipe").string() + ": is not a regular file");
}

TEST(RandomAccessFile, ReadsFromAnywhereAndNotBehindTheEnd) {
  const ScratchFolder folder;
  spill(folder / "a", "0123456789");
  const auto file = RandomAccessFile::open(folder / "a");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->size(), 10U);
  std::vector<std::byte> bytes(3);
  ASSERT_TRUE(file->read_at(7, bytes));
  EXPECT_EQ(bytes, bytes_of("789"));
  const Status beyond = file->read_at(8, bytes);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().message,
            (folder / "a").string() +
                ": ends at byte 10, but byte 10 was expected; the file is truncated");
}

TEST(WriteFile, ReplacesTheOldFileAndLeavesNothingElse) {
  const ScratchFolder folder;
  spill(folder / "a", "old");
  ASSERT_TRUE(write_file_atomically(folder / "a", bytes_of("new")));
  EXPECT_EQ(slurp(folder / "a"), "new");
  EXPECT_EQ(folder.count(), 1);
}

TEST(WriteFile, GivesTheUsualPermissions) {
  const ScratchFolder folder;
  const mode_t mask = ::umask(027);
  const Status written = write_file_atomically(folder / "a", bytes_of("x"));
  ::umask(mask);
  ASSERT_TRUE(written);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

TEST(WriteFile, FollowsLinks) {
  const ScratchFolder folder;
  spill(folder / "a", "old");
  std::filesystem::create_symlink("a", folder / "link");
  std::filesystem::create_symlink("b", folder / "dangling");
  ASSERT_TRUE(write_file_atomically(folder / "link", bytes_of("new")));
  ASSERT_TRUE(write_file_atomically(folder / "dangling", bytes_of("new")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(slurp(folder / "a"), "new");
  EXPECT_EQ(slurp(folder / "b"), "new");
  EXPECT_EQ(folder.count(), 4);
}

TEST(WriteFile, SaysWhatIsWrong) {
  const ScratchFolder folder;
  const auto message = [](const std::filesystem::path& path) {
    const Status written = write_file_atomically(path, bytes_of("x"));
    return written ? std::string() : written.error().message;
  };
  const std::string in_none = (folder.path() / "none" / "a").string();
  EXPECT_EQ(message(in_none),
            in_none + ": cannot be written: there is no directory " + (folder / "none").string());
  EXPECT_EQ(message(folder.path()),
            folder.path().string() + ": is a directory; name a file to write to");
  EXPECT_EQ(message(folder.path() / ""),
            folder.path().string() + "/: is a directory; name a file to write to");
  // A file where a directory is expected.
  spill(folder / "file", "");
  EXPECT_NE(message(folder.path() / "file" / "a").find("cannot be written"), std::string::npos);
  // Renaming over a device would replace it for the whole system.
  EXPECT_EQ(message("/dev/full"), "/dev/full: is not a regular file, so it cannot be written to");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_EQ(folder.count(), 1);
}

TEST(WriteFile, LeavesTheOldFileWhenTheDiskIsFull) {
  const ScratchFolder folder;
  spill(folder / "a", "old");
  const Status written = [&] {
    const FileSizeLimit limit(1000);
    return write_file_atomically(folder / "a", bytes_of(std::string(5000, 'x')));
  }();
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message,
            (folder / "a").string() + ": cannot be written: file too large");
  EXPECT_EQ(slurp(folder / "a"), "old");
  EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, LeavesNothingWithoutACommit) {
  const ScratchFolder folder;
  {
    auto file = AtomicFile::create(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write(bytes_of("half")));
    EXPECT_EQ(folder.count(), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  }
  EXPECT_EQ(folder.count(), 0);
}

TEST(AtomicFile, WritersOfOneFileDoNotMeet) {
  const ScratchFolder folder;
  auto first = AtomicFile::create(folder / "a");
  auto second = AtomicFile::create(folder / "a");
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  ASSERT_TRUE(first->write(bytes_of("first")));
  ASSERT_TRUE(second->write(bytes_of("second")));
  ASSERT_TRUE(first->commit());
  EXPECT_EQ(slurp(folder / "a"), "first");
  ASSERT_TRUE(second->commit());
  EXPECT_EQ(slurp(folder / "a"), "second");
  EXPECT_EQ(folder.count(), 1);
}

/// Each writer of a user's file: one sentence and no file when the disk is full.
TEST(FullDisk, LeavesNoPartialFile) {
  const ScratchFolder folder;
  const PatchModel model = test::bumpy_model(6);
  Image image{64, 64, {}};  // of noise, which does not compress
  std::mt19937 random(1);
  for (const char* name : {"R", "G", "B"}) {
    image.channels.push_back({name, ChannelType::Float, {}});
    for (int k = 0; k < 64 * 64; ++k) {
      image.channels.back().values.push_back(static_cast<float>(random() % 4096) / 4096.0F);
    }
  }
  const auto expect_failure = [&](const char* name, const auto& write) {
    const std::filesystem::path path = folder / name;
    const Status written = [&] {
      const FileSizeLimit limit(2000);
      return write(path);
    }();
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().message, path.string() + ": cannot be written: file too large");
    EXPECT_EQ(folder.count(), 0);
    // Only the full disk was in the way.
    ASSERT_TRUE(write(path)) << name;
    std::filesystem::remove(path);
  };
  expect_failure("a.relief", [&](const auto& path) { return write_patch_file(path, model); });
  expect_failure("a.exr", [&](const auto& path) { return write_exr(path, image); });
  expect_failure("a.png", [&](const auto& path) { return write_png(path, image); });
}

}  // namespace
}  // namespace relief
