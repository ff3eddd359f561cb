#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "preprocess/readers/format.h"
#include "preprocess/readers/gzip/gunzip.h"
#include "preprocess/readers/read_points.h"
#include "tests/preprocess/readers/sample_files.h"

namespace relief::test {
namespace {

/// A directory that lives as long as a test.
class ReadPointsTest : public testing::Test {
 protected:
  ReadPointsTest() {
    const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
    directory_ = std::filesystem::temp_directory_path() /
                 fmt::format("relief-{}-{}", ::getpid(), info->name());
    std::filesystem::create_directory(directory_);
  }
  ~ReadPointsTest() override { std::filesystem::remove_all(directory_); }

  [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(directory_ / name, std::ios::binary) << bytes;
    return directory_ / name;
  }

  std::filesystem::path directory_;
  Progress progress_;
};

TEST(ReadBytesTest, ReadsEachFormatPlainAndGzipped) {
  for (const SampleFile& file : sample_files()) {
    const Points plain = read(file.name, file.bytes);
    EXPECT_GE(plain.size(), 3U) << file.name;
    if (file.name.ends_with(".gz")) continue;
    EXPECT_EQ(read(file.name + ".gz", gzip(file.bytes)).positions, plain.positions) << file.name;
    // Packed files are recognised by their bytes, not by the name.
    EXPECT_EQ(read(file.name, gzip(file.bytes)).positions, plain.positions) << file.name;
  }
}

TEST(FormatTest, EachRowHasASampleAndOwnsItsExtensions) {
  std::set<std::string_view> sampled;
  for (const SampleFile& file : sample_files()) {
    if (file.name.ends_with(".gz")) continue;
    const auto format = find_format(file.name, file.bytes);
    ASSERT_TRUE(format) << format.error().message;
    sampled.insert((*format)->name);
  }
  for (const PointFormat& format : point_formats()) {
    EXPECT_TRUE(sampled.contains(format.name)) << format.name << " is missing in sample_files()";
    const auto found = find_format(fmt::format("a.{}.GZ", format.target()), "?");
    ASSERT_TRUE(found) << format.name;
    EXPECT_EQ((*found)->name, format.name);
    // Neither a part of an extension nor several are one.
    EXPECT_FALSE(format.has_extension(format.target().substr(1))) << format.name;
    EXPECT_FALSE(format.has_extension(""));
    if (format.extensions.find(' ') != std::string_view::npos) {
      EXPECT_FALSE(format.has_extension(format.extensions));
    }
  }
}

TEST(ReadBytesTest, TheBytesCountMoreThanTheName) {
  for (const SampleFile& file : sample_files()) {
    const auto format = find_format(file.name, file.bytes);
    if (!format || (*format)->recognises == nullptr || !(*format)->recognises(file.bytes)) continue;
    EXPECT_EQ(read("a.obj", file.bytes).positions, read(file.name, file.bytes).positions)
        << file.name;
  }
}

TEST(ReadBytesTest, AGzipFileMayHaveSeveralMembersAndZerosBehind) {
  const std::string parts = gzip("1 2 3\n4 5") + gzip(" 6\n") + std::string(100, '\0');
  EXPECT_EQ(read("a.xyz.gz", parts).size(), 2U);
  EXPECT_NE(error("a.xyz.gz", gzip("1 2 3\n") + "garbage").find("followed by something else"),
            std::string::npos);
}

TEST(ReadBytesTest, TheSizeThatAGzipFileClaimsIsNotTrusted) {
  std::string packed = gzip("1 2 3\n4 5 6\n");
  packed.replace(packed.size() - 4, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_NE(error("a.xyz.gz", packed).find("incorrect length check"), std::string::npos);
}

TEST(GunzipTest, AFileThatGrowsBeyondTheLimitIsRefused) {
  const std::vector<char> zeros(10'000'000);
  const std::string bomb = gzip({zeros.data(), zeros.size()});
  ASSERT_LT(bomb.size(), 20'000U);
  const Progress progress;
  const auto out = gunzip("a.ply", std::as_bytes(std::span(bomb)), 4'000'000, progress);
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().message,
            "a.ply: decompresses to more than 4 MB, which this machine's memory cannot hold");
}

// 300 MB of zeros are packed 1030 times.
TEST(GunzipTest, UnpackingStopsAtARatioWhateverTheMemory) {
  const std::vector<char> zeros(300'000'000);
  const std::string bomb = gzip({zeros.data(), zeros.size()});
  const std::uint64_t most = std::max(kAnyRatioBytes, kLargestRatio * bomb.size());
  ASSERT_LT(most, zeros.size());
  std::uint64_t unpacked = 0;
  const Progress progress;
  const Status done = gunzip_pieces("a.ply", std::as_bytes(std::span(bomb)), progress,
                                    [&](std::span<const std::byte> piece, std::size_t) {
                                      unpacked += piece.size();
                                      return Status();
                                    });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message,
            "a.ply: decompresses to more than 200 times its size, which no scan should; decompress "
            "it with gunzip first if it is one");
  EXPECT_LE(unpacked, most);
  EXPECT_GT(unpacked, most - 100'000);  // a piece has 64 KiB
}

TEST(ReadBytesTest, SaysWhatCannotBeRead) {
  EXPECT_EQ(error("empty.ply", ""), "empty.ply: the file is empty");
  EXPECT_EQ(error("empty.xyz.gz", gzip("")), "empty.xyz.gz: the file is empty");
  EXPECT_EQ(error("a.ply", "solid gold"),
            "a.ply: does not begin with 'ply', so it is not a PLY file");
  EXPECT_EQ(readable_formats(), "PLY, PCD, LAS, PTX, OBJ, glTF, Draco, OFF, STL and XYZ text");
  EXPECT_EQ(streamed_formats(), "PLY, LAS and XYZ text");
  EXPECT_EQ(error("a.foo", "1 2 3\n"),
            "a.foo: neither its content nor its extension is of a readable format; readable "
            "formats are " +
                readable_formats() + ", plain or gzipped; --format names one");
  EXPECT_EQ(error("a.zip", "PK\x03\x04..."),
            "a.zip: is a ZIP archive, which cannot be read; readable formats are " +
                readable_formats() + ", plain or gzipped");
  EXPECT_EQ(error("a.xyz", {"1\0 2\0 3\0\n\0", 9}),
            "a.xyz: contains bytes of value 0, so it is not XYZ text as its extension says");
  EXPECT_EQ(error("a.xyz", "nan nan nan\ninf 0 0\n"),
            "a.xyz: holds no points: the coordinates of all 2 are NaN or infinite");
}

TEST_F(ReadPointsTest, UnreadableFilesAreRefusedByName) {
  for (const auto& path : {directory_ / "missing.ply", directory_, write("empty.ply", "")}) {
    const auto result = read_points(path, progress_);
    ASSERT_FALSE(result) << path;
    EXPECT_TRUE(result.error().message.starts_with(path.string() + ": ")) << result.error().message;
  }
}

TEST_F(ReadPointsTest, ReadsAFile) {
  const auto result =
      read_points(write("a.xyz.gz", gzip("1 2 3\n4 5 6\nnan 0 0\n1 2 3\n")), progress_);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->points_in_file, 4U);
  EXPECT_EQ(result->dropped_nonfinite, 1U);
  EXPECT_EQ(result->merged_duplicates, 1U);
  EXPECT_EQ(result->points.positions, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}}));
}

/// Asks to stop after some bytes.
class Impatient : public Progress {
 public:
  explicit Impatient(std::uint64_t patience) : patience_(patience) {}
  void begin_stage(std::string_view name, std::uint64_t units) override {
    stage = name;
    total = units;
  }
  void advance(std::uint64_t units) override { done += units; }
  [[nodiscard]] bool cancelled() const override { return done > patience_; }

  std::string stage;
  std::uint64_t total = 0;
  std::uint64_t done = 0;

 private:
  std::uint64_t patience_;
};

TEST_F(ReadPointsTest, ReportsProgressAndCanBeCancelled) {
  std::string text;
  for (int i = 0; i < 500'000; ++i) text += fmt::format("{} 2 3\n", i);
  const auto path = write("a.xyz", text);
  Impatient patient(UINT64_MAX - 1);
  ASSERT_TRUE(read_points(path, patient));
  EXPECT_EQ(patient.stage, "read");
  EXPECT_EQ(patient.total, text.size());
  EXPECT_LE(patient.done, text.size());
  EXPECT_GT(patient.done, text.size() / 2);
  Impatient impatient(text.size() / 4);
  const auto stopped = read_points(path, impatient);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().message, interrupted_error().message);
}

}  // namespace
}  // namespace relief::test
