// Files read in blocks give what they give as a whole.
#include "preprocess/tiles/scan_blocks.h"

#include <gtest/gtest.h>

#include "preprocess/readers/read_points.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/readers/las_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief {
namespace {

using test::pack;
using test::ScratchFolder;
using test::spill;

const ReadOptions kAllScalars{.scalars = {.all = true, .names = {}}};

constexpr std::size_t kScanPoints = 3 * 65536 + 17;  // three blocks and something

struct Gathered {
  Points points;
  std::size_t blocks = 0;
  ScanCounts counts;
  std::vector<std::string> notes;
};

Gathered gather(const std::vector<std::filesystem::path>& files, const ScratchFolder& folder) {
  Gathered all;
  Progress progress;
  const auto counts = read_blocks(
      files, folder.path(), kAllScalars, std::uint64_t{1} << 30U,
      [&](const Points& block) -> Status {
        if (block.size() == 0) return {};
        ++all.blocks;
        Points& to = all.points;
        to.positions.insert(to.positions.end(), block.positions.begin(), block.positions.end());
        to.normals.insert(to.normals.end(), block.normals.begin(), block.normals.end());
        to.colours.insert(to.colours.end(), block.colours.begin(), block.colours.end());
        if (to.scalars.empty()) to.scalars.resize(block.scalars.size());
        EXPECT_EQ(to.scalars.size(), block.scalars.size());
        for (std::size_t k = 0; k < std::min(to.scalars.size(), block.scalars.size()); ++k) {
          const PointScalar& scalar = block.scalars[k];
          to.scalars[k].name = scalar.name;
          to.scalars[k].values.insert(to.scalars[k].values.end(), scalar.values.begin(),
                                      scalar.values.end());
        }
        return {};
      },
      all.notes, progress);
  EXPECT_TRUE(counts) << counts.error().message;
  if (counts) all.counts = *counts;
  return all;
}

std::string gather_error(const std::filesystem::path& file, const ScratchFolder& folder,
                         std::uint64_t memory = std::uint64_t{1} << 30U,
                         const ReadOptions& options = {}) {
  Progress progress;
  std::vector<std::string> notes;
  const auto counts = read_blocks(
      {file}, folder.path(), options, memory, [](const Points&) -> Status { return {}; }, notes,
      progress);
  return counts ? "no error" : counts.error().message;
}

void expect_as_whole(const std::filesystem::path& file, const ScratchFolder& folder) {
  Progress progress;
  const auto whole = read_points(file, progress, kAllScalars);
  ASSERT_TRUE(whole) << whole.error().message;
  const Gathered blocks = gather({file}, folder);
  EXPECT_GE(blocks.blocks, 3U);
  EXPECT_EQ(blocks.counts.points, whole->points.size());
  EXPECT_EQ(blocks.counts.nonfinite, whole->dropped_nonfinite);
  EXPECT_EQ(blocks.counts.left_out, whole->left_out);
  EXPECT_EQ(blocks.points.positions, whole->points.positions);
  EXPECT_EQ(blocks.points.normals, whole->points.normals);
  EXPECT_EQ(blocks.points.colours, whole->points.colours);
  ASSERT_EQ(blocks.points.scalars.size(), whole->points.scalars.size());
  for (std::size_t k = 0; k < whole->points.scalars.size(); ++k) {
    EXPECT_EQ(blocks.points.scalars[k].name, whole->points.scalars[k].name);
    EXPECT_EQ(blocks.points.scalars[k].values, whole->points.scalars[k].values);
  }
}

std::string ply(std::string_view format, std::size_t points, bool faces) {
  std::string text = fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty "
      "double "
      "z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty "
      "uchar green\nproperty uchar blue\nproperty short quality\n",
      format, points);
  if (faces) text += "element face 1\nproperty list uchar int vertex_indices\n";
  text += "end_header\n";
  for (std::size_t i = 0; i < points; ++i) {
    const double x = 0.5 * static_cast<double>(i);
    const auto red = static_cast<std::uint8_t>(i % 251);
    if (format == "ascii") {
      text += fmt::format("{} 1 -2 0 0 1 {} 7 9 {}\n", i % 1000 == 5 ? "nan" : fmt::format("{}", x),
                          red, i % 1001);
    } else {
      text += pack(test::ByteOrder::Little, i % 1000 == 5 ? std::nan("") : x, 1.0, -2.0, 0.F, 0.F,
                   1.F, red, std::uint8_t{7}, std::uint8_t{9}, static_cast<std::int16_t>(i % 1001));
    }
  }
  if (faces) text += pack(test::ByteOrder::Little, std::uint8_t{3}, 0, 1, 2);
  return text;
}

TEST(ScanBlocks, PlyIsAsReadAsAWhole) {
  const ScratchFolder folder;
  for (const char* format : {"ascii", "binary_little_endian"}) {
    spill(folder / "a.ply", ply(format, kScanPoints, false));
    expect_as_whole(folder / "a.ply", folder);
  }
}

TEST(ScanBlocks, FacesAreLeftOutWithANote) {
  const ScratchFolder folder;
  spill(folder / "a.ply", ply("binary_little_endian", 100, true));
  const Gathered blocks = gather({folder / "a.ply"}, folder);
  EXPECT_EQ(blocks.counts.points, 99U);  // one is NaN
  ASSERT_EQ(blocks.notes.size(), 1U);
  EXPECT_NE(blocks.notes[0].find("1 elements 'face' are not used with --memory"), std::string::npos)
      << blocks.notes[0];
}

TEST(ScanBlocks, LasIsAsReadAsAWhole) {
  const ScratchFolder folder;
  test::LasFile las;
  las.format = 2;
  for (std::size_t i = 0; i < kScanPoints; ++i) {
    test::LasPoint point;
    point.steps = {static_cast<std::int32_t>(i), -5, 7};
    point.withheld = i % 100 == 3;
    // Only the last block shows that colours have 16 bits.
    point.colour = {static_cast<std::uint16_t>(i + 1 == kScanPoints ? 65535 : i % 256), 0, 3};
    las.points.push_back(point);
  }
  spill(folder / "a.las", test::las_file(las));
  expect_as_whole(folder / "a.las", folder);
}

TEST(ScanBlocks, XyzIsAsReadAsAWholePlainAndPacked) {
  const ScratchFolder folder;
  std::string text = "x y z r g b quality\n";
  for (std::size_t i = 0; i < kScanPoints; ++i)
    text += fmt::format("{}.5 {} 3 {} 20 255 {}\n", i, i % 7, i % 256, i % 1001);
  spill(folder / "a.xyz", text);
  expect_as_whole(folder / "a.xyz", folder);
  spill(folder / "b.xyz.gz", test::gzip(text));
  expect_as_whole(folder / "b.xyz.gz", folder);
}

TEST(ScanBlocks, AScalarThatAFileLacksIsMissed) {
  const ScratchFolder folder;
  spill(folder / "a.ply", ply("binary_little_endian", 100, false));
  const ReadOptions options{.scalars = {.all = false, .names = {"time"}}};
  EXPECT_EQ(gather_error(folder / "a.ply", folder, std::uint64_t{1} << 30U, options),
            (folder / "a.ply").string() + ": has no scalar 'time'; it has quality");
}

TEST(ScanBlocks, FilesComeOneAfterAnother) {
  const ScratchFolder folder;
  spill(folder / "a.xyz", "1 2 3\n4 5 6\n");
  spill(folder / "b.xyz", "7 8 9\n");
  const Gathered blocks = gather({folder / "a.xyz", folder / "b.xyz"}, folder);
  const std::vector<glm::dvec3> expected{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(blocks.points.positions, expected);
}

TEST(ScanBlocks, ColoursThatGrowBeyondTheirFirstScaleAreRefused) {
  const ScratchFolder folder;
  std::string text;
  for (std::size_t i = 0; i < kScanPoints; ++i)
    text += fmt::format("{} 2 3 {} 20 255\n", i, i + 1 == kScanPoints ? 65535 : 0);
  spill(folder / "a.xyzrgb", text);
  // The last points are fewer than a block, and read with the scale of those before.
  EXPECT_EQ(gather_error(folder / "a.xyzrgb", folder), "no error");
  for (std::size_t i = 0; i < 65536; ++i) text += "1 2 3 65535 20 255\n";
  spill(folder / "a.xyzrgb", text);
  EXPECT_NE(
      gather_error(folder / "a.xyzrgb", folder).find("have colours up to 255, later ones larger"),
      std::string::npos)
      << gather_error(folder / "a.xyzrgb", folder);
}

TEST(ScanBlocks, FormatsThatAreReadAsAWholeMustFit) {
  const ScratchFolder folder;
  std::string obj;
  for (int i = 0; i < 1000; ++i) obj += "v 1 2 3\n";
  spill(folder / "a.obj", obj);
  EXPECT_EQ(gather_error(folder / "a.obj", folder), "no error");
  EXPECT_NE(gather_error(folder / "a.obj", folder, 10000).find("can only be read as a whole"),
            std::string::npos);
}

TEST(ScanBlocks, DamageIsFoundAsItIsInTheWhole) {
  const ScratchFolder folder;
  const std::string good = ply("binary_little_endian", kScanPoints, false);
  spill(folder / "a.ply", good.substr(0, good.size() - 1));
  EXPECT_NE(gather_error(folder / "a.ply", folder).find("truncated"), std::string::npos);
  const std::string packed = test::gzip(good);
  spill(folder / "b.ply.gz", packed.substr(0, packed.size() / 2));
  EXPECT_NE(gather_error(folder / "b.ply.gz", folder).find("truncated"), std::string::npos);
  // Nothing half unpacked is left to be taken for the file.
  EXPECT_FALSE(std::filesystem::exists(folder / "unpacked-0"));
}

TEST(ScanBlocksTest, SelectsAsReadingAtOnceDoes) {
  test::LasFile file{.format = 0};
  for (std::int32_t k = 0; k < 150000; ++k) {
    file.points.push_back({{k, k % 977, 0},
                           static_cast<std::uint8_t>(k % 5),
                           false,
                           {},
                           static_cast<unsigned>(1 + k % 2),
                           2});
  }
  const ScratchFolder folder;
  const auto path = folder.path() / "a.las";
  spill(path, test::las_file(file));
  ReadOptions options;
  options.selection.classes.set(1).set(3);
  options.selection.returns = ReturnChoice::Last;
  options.selection.crop = Bounds{{100, 1, -1}, {1200.5, 9, 1}};
  Progress progress;
  const auto whole = read_points(path, progress, options);
  ASSERT_TRUE(whole);
  std::vector<glm::dvec3> positions;
  std::vector<std::string> notes;
  const auto counts = read_blocks(
      {path}, folder.path(), options, std::uint64_t{1} << 30U,
      [&](const Points& block) -> Status {
        positions.insert(positions.end(), block.positions.begin(), block.positions.end());
        return {};
      },
      notes, progress);
  ASSERT_TRUE(counts);
  EXPECT_GT(positions.size(), 10000U);
  EXPECT_EQ(positions, whole->points.positions);
  EXPECT_EQ(counts->points, positions.size());
  EXPECT_EQ(counts->not_selected, whole->not_selected);
  EXPECT_EQ(counts->points + counts->not_selected, 150000U);
  // A box beside the scan, and a class that no block has.
  options.selection.crop = Bounds{{-2, -2, -1}, {-1, -1, 1}};
  const auto none = read_blocks(
      {path}, folder.path(), options, std::uint64_t{1} << 30U,
      [](const Points&) -> Status { return {}; }, notes, progress);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no point lies in --crop -2,-2,-1,-1"), std::string::npos);
}

}  // namespace
}  // namespace relief
