// Conversions in tiles that are ended early and gone on with.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/noise/noisy_surfaces.h"
#include "tests/preprocess/surfaces.h"
#include "tests/preprocess/tiles/small_tiles.h"
#include "tests/preprocess/tiles/write_ply.h"

namespace relief {
namespace {

namespace fs = std::filesystem;
using test::must_convert;
using test::read_whole;
using test::ScratchFolder;
using test::slurp;
using test::spill;
using test::try_convert;
using test::write_ply;

/// Ends a conversion when it has asked so many times whether to stop; counts how often it asks.
class StopsAfter final : public Progress {
 public:
  explicit StopsAfter(std::int64_t times) : times_(times) {}
  [[nodiscard]] bool cancelled() const override { return asked_.fetch_add(1) >= times_; }
  [[nodiscard]] std::int64_t asked() const { return asked_; }

 private:
  std::int64_t times_;
  mutable std::atomic<std::int64_t> asked_{0};
};

class ResumedTiles : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Seams, ResumedTiles, testing::Bool());

TEST_P(ResumedTiles, AreThoseOfOneRun) {
  const ScratchFolder folder;
  ConvertOptions options;
  options.seams = GetParam();
  const fs::path scan = folder / "torus.ply";
  const fs::path output = folder / "torus.relief";
  Points points = test::sample_torus({}, 0.025);
  points.positions = test::with_noise({points.positions, 0.025}, 0.25);
  write_ply(scan, points);
  StopsAfter never(std::int64_t{1} << 60U);
  ASSERT_TRUE(try_convert(scan, folder / "whole.relief", never, options));
  const std::string expected = slurp(folder / "whole.relief");
  for (int tenth = 0; tenth < 10; ++tenth) {
    SCOPED_TRACE(tenth);
    StopsAfter progress(never.asked() * tenth / 10);
    const auto stopped = try_convert(scan, output, progress, options);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().message, "interrupted");
    EXPECT_FALSE(fs::exists(output));
    must_convert(scan, output, options);
    EXPECT_TRUE(slurp(output) == expected);
    EXPECT_FALSE(find_kept_tiles(output));
    fs::remove(output);
  }
}

/// Ends a conversion when three tiles have their patches.
class StopsAtThirdTile final : public Progress {
 public:
  void begin_stage(std::string_view name, std::uint64_t /*units*/) override {
    is_resampling_ = name == "resample";
  }
  void advance(std::uint64_t /*units*/) override { tiles_ += is_resampling_ ? 1 : 0; }
  [[nodiscard]] bool cancelled() const override { return tiles_ >= 3; }

 private:
  bool is_resampling_ = false;
  int tiles_ = 0;
};

void stop_in_the_middle(const fs::path& scan, const fs::path& output) {
  StopsAtThirdTile progress;
  ASSERT_FALSE(try_convert(scan, output, progress)) << "it came to its end";
  ASSERT_TRUE(fs::exists(output.string() + ".parts/part-2.relief"));
}

TEST(ResumedTilesOf, FinishedTilesAreKept) {
  const ScratchFolder folder;
  const fs::path scan = folder / "torus.ply";
  write_ply(scan, test::sample_torus({}, 0.025));
  EXPECT_EQ(must_convert(scan, folder / "whole.relief").tiles_found, 0U);
  stop_in_the_middle(scan, folder / "torus.relief");
  EXPECT_EQ(must_convert(scan, folder / "torus.relief").tiles_found, 3U);
  EXPECT_TRUE(slurp(folder / "torus.relief") == slurp(folder / "whole.relief"));
}

TEST(ResumedTilesOf, RestartsIfFilesOrOptionsChanged) {
  const ScratchFolder folder;
  const fs::path scan = folder / "torus.ply";
  const fs::path output = folder / "torus.relief";
  write_ply(scan, test::sample_torus({}, 0.02));
  stop_in_the_middle(scan, output);
  ConvertOptions options;
  options.spacing = 0.03;
  EXPECT_EQ(must_convert(scan, output, options).tiles_found, 0U);
  EXPECT_EQ(read_whole(output).spacing, 0.03);
  fs::remove(output);
  stop_in_the_middle(scan, output);
  write_ply(scan, test::sample_torus({1.0, 0.3}, 0.018));
  EXPECT_EQ(must_convert(scan, output).tiles_found, 0U);
  EXPECT_NEAR(read_whole(output).bounding_radius, 1.3, 0.01);
}

TEST(ResumedTilesOf, DamagedPartsAreRefused) {
  const ScratchFolder folder;
  const fs::path scan = folder / "torus.ply";
  const fs::path output = folder / "torus.relief";
  write_ply(scan, test::sample_torus({}, 0.02));
  stop_in_the_middle(scan, output);
  const fs::path part = output.string() + ".parts/part-1.relief";
  spill(part, slurp(part).substr(0, 200));
  Progress progress;
  const auto result = try_convert(scan, output, progress);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("part-1.relief"), std::string::npos);
  EXPECT_FALSE(fs::exists(output));
}

TEST(ResumedTilesOf, FoldersOfOthersAreNotTouched) {
  const ScratchFolder folder;
  write_ply(folder / "torus.ply", test::sample_torus({}, 0.02));
  fs::create_directory(folder / "torus.relief.parts");
  spill(folder / "torus.relief.parts" / "diary", "mine");
  Progress progress;
  const auto result = try_convert(folder / "torus.ply", folder / "torus.relief", progress);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("is not a folder that relief made"), std::string::npos);
  EXPECT_EQ(slurp(folder / "torus.relief.parts" / "diary"), "mine");
}

}  // namespace
}  // namespace relief
