// Conversions in tiles of scans of any size that lie in any direction.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/extremes/turned_scans.h"
#include "tests/preprocess/tiles/small_tiles.h"
#include "tests/preprocess/tiles/write_ply.h"

namespace relief {
namespace {

/// 28,000 points, which tiles_of() has for more than memory holds.
Points large_torus() {
  return test::bent_torus(0.024);
}

struct Converted {
  TiledResult result;
  PatchModel model;
};

Converted in_tiles(const Points& points, double scale = 1.0, const ConvertOptions& options = {}) {
  const test::ScratchFolder folder;
  Points scaled = points;
  for (glm::dvec3& p : scaled.positions) p *= scale;
  test::write_ply(folder / "scan.ply", scaled);
  Converted converted;
  converted.result = test::must_convert(folder / "scan.ply", folder / "scan.relief", options);
  converted.model = test::read_whole(folder / "scan.relief");
  return converted;
}

// Dividing by a power of two is exact. Tiles were converted in world units: others at 2^40, and at
// 2^-40 the survey did not end.
TEST(TilesOfAnySize, HaveTheSamePatches) {
  const Converted as_it_is = in_tiles(large_torus());
  EXPECT_GT(as_it_is.result.tiles, 4U);
  for (const int exponent : {-40, 40}) {
    const double scale = std::ldexp(1.0, exponent);
    const Converted scaled = in_tiles(large_torus(), scale);
    EXPECT_EQ(scaled.result.tiles, as_it_is.result.tiles);
    EXPECT_EQ(scaled.result.report.error_rms, scale * as_it_is.result.report.error_rms);
    EXPECT_EQ(scaled.result.report.psnr_db, as_it_is.result.report.psnr_db);
    EXPECT_EQ(scaled.model.spacing, scale * as_it_is.model.spacing);
    EXPECT_EQ(scaled.model.bounding_radius, scale * as_it_is.model.bounding_radius);
    ASSERT_EQ(scaled.model.patches.size(), as_it_is.model.patches.size());
    for (std::size_t p = 0; p < scaled.model.patches.size(); ++p) {
      EXPECT_EQ(scaled.model.patches[p].origin, scale * as_it_is.model.patches[p].origin);
      EXPECT_EQ(scaled.model.patches[p].spacing, scale * as_it_is.model.patches[p].spacing);
      EXPECT_EQ(scaled.model.patches[p].heights, as_it_is.model.patches[p].heights);
    }
  }
}

TEST(TilesOfAnySize, HaveTheLengthsOfTheirOptions) {
  ConvertOptions options;
  options.spacing = 0.03;
  options.height_step = 0.001;
  options.side = {.side = NormalSide::Toward, .toward = {0.0, 0.0, 9.0}};
  const Converted as_it_is = in_tiles(large_torus(), 1.0, options);
  EXPECT_EQ(as_it_is.model.spacing, options.spacing);
  options.spacing *= 1024.0;
  options.height_step *= 1024.0;
  options.side.toward *= 1024.0;
  const Converted scaled = in_tiles(large_torus(), 1024.0, options);
  EXPECT_EQ(scaled.model.spacing, options.spacing);
  ASSERT_EQ(scaled.model.patches.size(), as_it_is.model.patches.size());
  for (std::size_t p = 0; p < scaled.model.patches.size(); ++p) {
    EXPECT_EQ(scaled.model.patches[p].height_step, 1024.0 * as_it_is.model.patches[p].height_step);
    EXPECT_EQ(scaled.model.patches[p].heights, as_it_is.model.patches[p].heights);
  }
}

// Tiles were boxes of the world: other tiles for each turn, and other patches.
TEST(TurnedTiles, HaveTheSamePatches) {
  const Converted as_it_is = in_tiles(large_torus());
  for (const glm::dmat3& matrix : {test::turn(37, {1, 2, 3}), test::kMirror}) {
    const Converted turned = in_tiles(test::turned(large_torus(), matrix));
    EXPECT_EQ(turned.result.tiles, as_it_is.result.tiles);
    test::expect_turned(as_it_is.model, turned.model, matrix);
  }
}

TEST(TurnedTiles, FaceWhereTheOptionsSay) {
  for (const double z : {-9.0, 9.0}) {
    ConvertOptions options;
    options.side = {.side = NormalSide::Toward, .toward = {1.0, 0.5, z}};
    Points sheet = test::square_mesh({220, 130}, 0.01, [](double x, double y) {
      return 0.3 * x + 0.02 * std::sin(4.0 * x) * y;
    });
    sheet.triangles.clear();
    const PatchModel model = in_tiles(sheet, 1.0, options).model;
    for (const Patch& patch : model.patches) EXPECT_GT(patch.axes[2].z * z, 0.0);
  }
}

}  // namespace
}  // namespace relief
