// Heights come back from the patch file as they stand in the raster.
#include "preprocess/raster/convert_raster.h"

#include <gtest/gtest.h>

#include <map>

#include "common/image/image_formats.h"
#include "common/octahedral.h"
#include "common/patch_file/patch_file.h"
#include "preprocess/raster/gdal.h"
#include "preprocess/raster/raster.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/raster/raster_files.h"

namespace relief::test {
namespace {

namespace fs = std::filesystem;

class ConvertRasterTest : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) {
    spill(folder_.path() / name, bytes);
    return folder_.path() / name;
  }

  /// Converts, writes the patch file and reads it.
  PatchModel convert_file(const fs::path& path, const ConvertOptions& options = {},
                          const ReadOptions& read = {}, const TextureChoice& texture = {},
                          PatchCodec codec = PatchCodec::Fast) {
    auto converted = convert_raster(path, texture, options, read, progress_);
    if (!converted) {
      ADD_FAILURE() << converted.error().message;
      return {};
    }
    report_ = converted->report;
    const fs::path file = folder_.path() / "out.relief";
    const Status written = write_patch_file(file, converted->model, {.codec = codec});
    EXPECT_TRUE(written) << written.error().message;
    auto opened = PatchFile::open(file);
    EXPECT_TRUE(opened);
    auto model = opened->read_all(progress_);
    EXPECT_TRUE(model);
    return std::move(*model);
  }

  std::string error_of(const fs::path& path, const ConvertOptions& options = {},
                       const ReadOptions& read = {}, const TextureChoice& texture = {}) {
    const auto converted = convert_raster(path, texture, options, read, progress_);
    return converted ? "no error" : converted.error().message;
  }

  /// Every sample of the patches must be a cell of the raster, and every cell with data a sample.
  /// `origin`: the world position of the cell in the south-west, `unit`: world units a height.
  static void expect_cells(const PatchModel& model, const TestGrid& grid, glm::dvec2 origin,
                           double cell, double unit, double tolerance) {
    std::vector<int> found(grid.heights.size(), 0);
    for_each_position(std::span<const Patch>(model.patches), [&](const glm::dvec3& p) {
      const glm::dvec2 at = (glm::dvec2(p) - origin) / cell;
      const auto i = static_cast<std::uint32_t>(std::lround(at.x));
      const auto south = static_cast<std::uint32_t>(std::lround(at.y));
      ASSERT_LT(i, grid.columns);
      ASSERT_LT(south, grid.rows);
      ASSERT_NEAR(at.x, i, 1e-6);
      ASSERT_NEAR(at.y, south, 1e-6);
      const std::uint32_t j = grid.rows - 1 - south;
      ++found[std::size_t{j} * grid.columns + i];
      // ASSERT_NEAR with 0 is equality.
      ASSERT_NEAR(p.z, grid.at(i, j) * unit, tolerance) << i << " " << j;
    });
    for (std::size_t k = 0; k < found.size(); ++k)
      ASSERT_EQ(found[k] > 0, !std::isnan(grid.heights[k])) << k;
  }

  ScratchFolder folder_;
  Progress progress_;
  ConvertReport report_;
};

TEST_F(ConvertRasterTest, WholeHeightsComeBackExactly) {
  const TestGrid grid = hills(600, 300);
  const fs::path file = write("grid.csv", csv_text(grid));
  for (const PatchCodec codec : {PatchCodec::Fast, PatchCodec::Compact}) {
    const PatchModel model = convert_file(file, {}, {}, {}, codec);
    EXPECT_EQ(model.patches.size(), 6U);
    EXPECT_EQ(model.spacing, 1.0);
    for (const Patch& patch : model.patches) {
      EXPECT_EQ(patch.axes, glm::dmat3(1.0));
      EXPECT_EQ(patch.height_step, 1.0);
      EXPECT_LE(std::max(patch.width, patch.height), 258U);
    }
    expect_cells(model, grid, {0, 0}, 1.0, 1.0, 0.0);
    EXPECT_EQ(report_.error_max, 0.0);
  }
}

TEST_F(ConvertRasterTest, NeighboursOverlapByACell) {
  const PatchModel model = convert_file(write("grid.csv", csv_text(hills(300, 20))));
  ASSERT_EQ(model.patches.size(), 2U);
  EXPECT_EQ(model.patches[0].width, 258U);
  EXPECT_EQ(model.patches[1].width, 300U - 256U);
  EXPECT_EQ(model.patches[1].origin.x, 256.0);
}

TEST_F(ConvertRasterTest, DecimalsComeBackExactly) {
  TestGrid grid = hills(40, 30);
  for (double& h : grid.heights) h = std::round(h * 100.0 + 37.0) / 100.0;
  const PatchModel model = convert_file(write("grid.csv", csv_text(grid)));
  // A sum of a multiple of 0.01 and others: rounding of double precision alone.
  expect_cells(model, grid, {0, 0}, 1.0, 1.0, 1e-9);
}

TEST_F(ConvertRasterTest, OtherHeightsAreRoundedToTheirRange) {
  TestGrid grid = hills(40, 30);
  for (double& h : grid.heights) h *= 0.123456789;
  const PatchModel model = convert_file(write("grid.csv", csv_text(grid)));
  // The range of 75 is at least 30,000 steps.
  expect_cells(model, grid, {0, 0}, 1.0, 1.0, 0.5 * 75.0 / 30000.0);
  EXPECT_GT(report_.error_max, 0.0);
  EXPECT_LE(report_.error_max, 0.5 * 75.0 / 30000.0);
}

TEST_F(ConvertRasterTest, NormalsAreThoseOfTheHeights) {
  TestGrid grid{20, 20, {}};
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 20; ++i) grid.heights.push_back(2.0 * i + 3.0 * (19 - j));
  }
  ConvertOptions options;
  options.spacing = 4.0;
  const PatchModel model = convert_file(write("grid.csv", csv_text(grid)), options);
  ASSERT_EQ(model.patches.size(), 1U);
  const glm::vec3 expected = glm::normalize(glm::vec3(-2.0F / 4, -3.0F / 4, 1));
  for (const glm::i16vec2 texel : model.patches[0].normals.texels) {
    // The patch file keeps normals to a tenth of a degree.
    EXPECT_GT(glm::dot(unit_from_snorm16(texel), expected), std::cos(0.2 * 3.14159 / 180));
  }
}

TEST_F(ConvertRasterTest, CropsByCoordinates) {
  const TestGrid grid = hills(40, 30);
  const fs::path file = write("grid.csv", csv_text(grid));
  constexpr double inf = std::numeric_limits<double>::infinity();
  ReadOptions read;
  read.selection.crop = Bounds{{30.5, 3, -inf}, {35, 8, inf}};
  const PatchModel model = convert_file(file, {}, read);
  EXPECT_EQ(model.bounds.min.x, 31.0);
  EXPECT_EQ(model.bounds.max.x, 35.0);
  EXPECT_EQ(model.bounds.min.y, 3.0);
  EXPECT_EQ(model.bounds.max.y, 8.0);
  for_each_position(std::span<const Patch>(model.patches), [&](const glm::dvec3& p) {
    EXPECT_EQ(p.z, grid.at(static_cast<std::uint32_t>(p.x), 29 - static_cast<std::uint32_t>(p.y)));
  });
  read.selection.crop = Bounds{{0, 0, 1000}, {40, 30, 1100}};
  const PatchModel band = convert_file(file, {}, read);
  EXPECT_GE(band.bounds.min.z, 1000.0);
  EXPECT_LE(band.bounds.max.z, 1100.0);
  read.selection.crop = Bounds{{100, 0, -inf}, {120, 30, inf}};
  EXPECT_EQ(error_of(file, {}, read),
            file.string() +
                ": fewer than 2 x 2 cells lie in --crop 100,0,120,30; the centres of its cells lie "
                "in 0,0,39,29");
}

TEST_F(ConvertRasterTest, SaysWhatIsWrong) {
  const fs::path file = write("grid.csv", csv_text(hills(20, 20)));
  const std::string name = file.string();
  ConvertOptions options;
  options.error = 0.1;
  options.seams = true;
  EXPECT_EQ(
      error_of(file, options),
      name + ": is a raster, whose cells become samples as they are; leave out --error, --seams");
  std::string ragged = csv_text(hills(20, 20));
  ragged.insert(ragged.size() - 1, ",7");
  EXPECT_EQ(error_of(write("ragged.csv", ragged)),
            (folder_.path() / "ragged.csv").string() +
                ": line 20: has 21 heights, but the lines before it have 20");
  std::string word = csv_text(hills(20, 20));
  word += "x" + word;
  EXPECT_NE(error_of(write("word.csv", word)).find("line 21: expected a height, found 'x"),
            std::string::npos);
  TestGrid empty{20, 20, std::vector<double>(400, NAN)};
  EXPECT_EQ(
      error_of(write("empty.csv", csv_text(empty))),
      (folder_.path() / "empty.csv").string() + ": has no heights: all cells are without data");
}

TEST_F(ConvertRasterTest, RecognisesRasters) {
  EXPECT_TRUE(is_raster(write("a.csv", csv_text(hills(16, 4))), ""));
  EXPECT_FALSE(is_raster(write("b.csv", "x,y,z\n1,2,3\n4,5,6\n"), ""));
  EXPECT_FALSE(is_raster(write("c.csv", "1,2,3,4,5,6\n1,2,3,4,5,6\n"), ""));
  EXPECT_TRUE(is_raster(folder_.path() / "c.csv", "grid"));
  EXPECT_FALSE(is_raster(folder_.path() / "a.csv", "xyz"));
  EXPECT_TRUE(is_raster(write("d.asc", "NCOLS 3\n"), ""));
  EXPECT_FALSE(is_raster(write("e.asc", "1 2 3\n"), ""));
  EXPECT_TRUE(is_raster(write("f", std::string("II*\0", 4)), ""));
  EXPECT_FALSE(is_raster(folder_.path() / "nothing.tif", ""));
}

/// A picture of four colours: red, green / blue, white.
std::string four_colours() {
  Image image{2, 2, {}};
  image.channels = {{"R", ChannelType::Half, {1, 0, 0, 1}},
                    {"G", ChannelType::Half, {0, 1, 0, 1}},
                    {"B", ChannelType::Half, {0, 0, 1, 1}}};
  const auto bytes = encode_png(image);
  return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

glm::u8vec3 colour_at(const Patch& patch, double x, double y) {
  const double scale = patch.colours.scale / patch.spacing;
  const auto i = static_cast<std::size_t>(std::lround((x - patch.origin.x) * scale));
  const auto j = static_cast<std::size_t>(std::lround((y - patch.origin.y) * scale));
  return patch.colours.texels[j * patch.colours.width + i];
}

TEST_F(ConvertRasterTest, APictureFitsToTheGrid) {
  const PatchModel model = convert_file(write("grid.csv", csv_text(hills(21, 21))), {}, {},
                                        {false, write("four.png", four_colours())});
  ASSERT_EQ(model.patches.size(), 1U);
  const Patch& patch = model.patches[0];
  EXPECT_TRUE(model.has_colours);
  EXPECT_EQ(colour_at(patch, 0, 20), glm::u8vec3(255, 0, 0));  // north-west
  EXPECT_EQ(colour_at(patch, 20, 20), glm::u8vec3(0, 255, 0));
  EXPECT_EQ(colour_at(patch, 0, 0), glm::u8vec3(0, 0, 255));
  EXPECT_EQ(colour_at(patch, 20, 0), glm::u8vec3(255, 255, 255));
  EXPECT_EQ(colour_at(patch, 10, 20), glm::u8vec3(128, 128, 0));
}

/// Those that need GDAL.
class GdalRasterTest : public ConvertRasterTest {
 protected:
  void SetUp() override {
    if (!has_gdal()) GTEST_SKIP() << "GDAL is not installed (Debian: gdal-bin)";
  }
};

TEST_F(GdalRasterTest, AnAsciiGridLiesAtItsCoordinates) {
  const TestGrid grid = hills(300, 40);
  const fs::path file = write("utm.asc", ascii_grid(grid, 500000, 4500000, 30));
  const PatchModel model = convert_file(file);
  expect_cells(model, grid, {500015, 4500015}, 30.0, 1.0, 0.0);
  EXPECT_EQ(model.patches[0].height_step, 1.0);
  // No file is left beside it.
  EXPECT_FALSE(fs::exists(folder_.path() / "utm.asc.aux.xml"));
}

TEST_F(GdalRasterTest, CentimetresComeBackExactly) {
  const TestGrid grid = hills(50, 40);
  const PatchModel model = convert_file(write("cm.asc", ascii_grid(grid, 0, 0, 2, 0.01)));
  // GDAL reads this format as single precision.
  expect_cells(model, grid, {1, 1}, 2.0, 0.01, 1e-6);
  EXPECT_NEAR(model.patches[0].height_step, 0.01, 1e-12);
}

TEST_F(GdalRasterTest, APictureWithCoordinatesLiesAtThem) {
  const fs::path file = write("utm.asc", ascii_grid(hills(20, 20), 0, 0, 10));
  const fs::path picture = write("four.png", four_colours());
  // Pixels of 50: 0 to 100 along x, 100 to 0 along y, half of the heights along each.
  write("four.pgw", "50\n0\n0\n-50\n25\n75\n");
  const PatchModel model = convert_file(file, {}, {}, {false, picture});
  ASSERT_EQ(model.patches.size(), 1U);
  const Patch& patch = model.patches[0];
  EXPECT_EQ(colour_at(patch, 25, 75), glm::u8vec3(255, 0, 0));
  EXPECT_EQ(colour_at(patch, 75, 75), glm::u8vec3(0, 255, 0));
  EXPECT_EQ(colour_at(patch, 25, 25), glm::u8vec3(0, 0, 255));
  EXPECT_EQ(colour_at(patch, 75, 25), glm::u8vec3(255, 255, 255));
  EXPECT_EQ(colour_at(patch, 195, 5), glm::u8vec3(255, 255, 255)) << "its edge goes on";
  write("four.pgw", "50\n0\n0\n-50\n10025\n75\n");
  EXPECT_EQ(error_of(file, {}, {}, {false, picture}),
            picture.string() +
                ": lies elsewhere: it covers 10000,0 to 10100,100, and the heights 5,5 to 195,195");
}

TEST_F(GdalRasterTest, DegreesBecomeMetres) {
  const TestGrid grid = hills(101, 101);
  const fs::path file = write("degrees.asc", ascii_grid(grid, 9.9495, 44.9495, 0.001));
  write("degrees.prj",
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
        "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]");
  const PatchModel model = convert_file(file);
  // About 10 E, 45 N a degree is 78,847 m to the east and 111,132 m to the north on WGS 84.
  const glm::dvec3 size = model.bounds.max - model.bounds.min;
  EXPECT_NEAR(size.y, 0.1 * 111132.0, 1.0 + model.spacing);
  EXPECT_NEAR(size.x, 0.1 * 78847.0, 1.0);
  EXPECT_NEAR(model.bounds.min.x, -0.05 * 78847.0, 1.0);
  // Cells are 78.8 m by 111.1 m; rows are interpolated to 78.8 m.
  EXPECT_NEAR(model.spacing, 78.847, 0.001);
}

TEST_F(GdalRasterTest, HostileHeadersAreRefused) {
  const TestGrid grid = hills(20, 20);
  std::string huge = ascii_grid(grid, 0, 0, 1);
  huge.replace(0, std::string("ncols 20\nnrows 20").size(), "ncols 1000000\nnrows 1000000");
  const std::string refused = error_of(write("huge.asc", huge));
  EXPECT_NE(refused.find("1000000 x 1000000 cells take"), std::string::npos) << refused;
  const std::string good = ascii_grid(grid, 0, 0, 1);
  for (std::size_t size = 1; size < good.size(); size += 7) {
    const auto cut = convert_raster(write("cut.asc", good.substr(0, size)), {}, {}, {}, progress_);
    if (!cut) {
      EXPECT_TRUE(cut.error().message.starts_with(folder_.path().string()));
    }
  }
  EXPECT_NE(error_of(write("bad.tif", "II*\0 and nothing")).find("GDAL cannot open it"),
            std::string::npos);
}

}  // namespace
}  // namespace relief::test
