#include "common/image/film_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

using test::ScratchFolder;

Image grey(std::uint32_t width, std::uint32_t height, float value) {
  Image image{width, height, {}};
  for (const char* name : {"R", "G", "B"}) {
    image.channels.push_back({name, ChannelType::Float, {}});
    image.channels.back().values.assign(std::size_t{width} * height, value);
  }
  return image;
}

/// A program called ffmpeg in a folder that is the first of the path.
class FakeFfmpeg {
 public:
  FakeFfmpeg(const std::filesystem::path& folder, const std::string& script)
      : path_(std::getenv("PATH")) {
    const std::filesystem::path program = folder / "ffmpeg";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ::setenv("PATH", (folder.string() + ":" + path_).c_str(), 1);
  }
  ~FakeFfmpeg() { ::setenv("PATH", path_.c_str(), 1); }
  FakeFfmpeg(const FakeFfmpeg&) = delete;
  FakeFfmpeg& operator=(const FakeFfmpeg&) = delete;

 private:
  std::string path_;
};

/// Writes what it is given to its last argument.
constexpr const char* kCopies = "for last; do :; done\ncat > \"$last\"\n";

TEST(FilmFile, GivesAllFramesToFfmpegAsBytes) {
  const ScratchFolder folder;
  const ScratchFolder bin;
  const FakeFfmpeg ffmpeg(bin.path(), kCopies);
  auto film = FilmFile::open(folder / "a.mp4", {3, 2, 25.0});
  ASSERT_TRUE(film) << film.error().message;
  ASSERT_TRUE(film->add(grey(3, 2, 0.0F)));
  ASSERT_TRUE(film->add(grey(3, 2, 1.0F)));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4")) << "not before it is complete";
  ASSERT_TRUE(film->finish());
  EXPECT_EQ(test::slurp(folder / "a.mp4"), std::string(18, '\0') + std::string(18, '\xFF'));
  EXPECT_EQ(folder.count(), 1);
}

TEST(FilmFile, LeavesNothingIfItIsNotFinished) {
  const ScratchFolder folder;
  const ScratchFolder bin;
  const FakeFfmpeg ffmpeg(bin.path(), kCopies);
  {
    auto film = FilmFile::open(folder / "a.webm", {3, 2, 25.0});
    ASSERT_TRUE(film);
    ASSERT_TRUE(film->add(grey(3, 2, 0.0F)));
  }
  EXPECT_EQ(folder.count(), 0);
}

TEST(FilmFile, SaysWhatFfmpegSays) {
  const ScratchFolder folder;
  const ScratchFolder bin;
  const FakeFfmpeg ffmpeg(bin.path(), "echo first >&2; echo 'no such codec' >&2; exit 1\n");
  auto film = FilmFile::open(folder / "a.mp4", {300, 200, 25.0});
  ASSERT_TRUE(film);
  // It may end before or after it has been given frames.
  Status added = film->add(grey(300, 200, 0.0F));
  for (int i = 0; i < 100 && added; ++i) added = film->add(grey(300, 200, 0.0F));
  const Status status = added ? film->finish() : added;
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            (folder / "a.mp4").string() + ": ffmpeg cannot write it: no such codec");
}

TEST(FilmFile, NeedsFfmpeg) {
  const ScratchFolder folder;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder.path()).c_str(), 1);
  const auto film = FilmFile::open(folder / "a.mp4", {3, 2, 25.0});
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_FALSE(film);
  EXPECT_NE(film.error().message.find("which is not installed"), std::string::npos);
}

}  // namespace
}  // namespace relief
