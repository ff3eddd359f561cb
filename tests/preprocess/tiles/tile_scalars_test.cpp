// Scalars of scans that are converted in tiles.
#include <gtest/gtest.h>

#include <cmath>

#include "common/patch_file/patch_tree.h"
#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/surfaces.h"
#include "tests/preprocess/tiles/small_tiles.h"
#include "tests/preprocess/tiles/write_ply.h"

namespace relief {
namespace {

constexpr double kSpacing = 0.02;

/// A number that grows with x and changes no whole number from point to point.
double ramp_at(const glm::dvec3& p) {
  return 7.25 + 1000.0 * p.x;
}

double label_at(const glm::dvec3& p) {
  return p.y < 0.0 ? 2.0 : 6.0;
}

/// A torus of 39,000 points with both, and a number that no point has.
Points torus_with_scalars() {
  Points points = test::sample_torus({}, kSpacing);
  PointScalar ramp{"ramp", false, {}};
  PointScalar label{"class", false, {}};
  for (const glm::dvec3& p : points.positions) {
    ramp.values.push_back(ramp_at(p));
    label.values.push_back(label_at(p));
  }
  const PointScalar nothing{"nothing", false, std::vector<double>(points.size(), std::nan(""))};
  points.scalars = {ramp, nothing, label};
  return points;
}

Status convert_with(const ScalarChoice& scalars, const ConvertOptions& options,
                    const test::ScratchFolder& folder) {
  TileOptions tiles = test::tiles_of(4000);
  tiles.memory_bytes = memory_for(24000, 2);
  tiles.read.scalars = scalars;
  Progress progress;
  RELIEF_TRY_ASSIGN(const auto made, convert_tiles({folder / "torus.ply"}, folder / "torus.relief",
                                                   options, {}, tiles, progress));
  return made ? Status() : make_error("it was not converted in tiles");
}

/// Checks the scalars of all samples, in patches of a spacing.
void expect_scalars(const PatchModel& model, const std::vector<ScalarInfo>& scalars,
                    double spacing) {
  std::size_t samples = 0;
  for (const Patch& patch : model.patches) {
    ASSERT_EQ(patch.scalars.size(), 2U);
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const glm::dvec3 p = position_of(patch, i, j);
        ++samples;
        // At the borders of patches values come from points beside them, as far as in
        // Overviews.ShowTheSurfaceFromItsSide.
        const double reach = 4.0 * spacing;
        const double ramp = scalars[0].value_of(texel_at(patch.scalars[0], i, j));
        ASSERT_NEAR(ramp, ramp_at(p), 1000.0 * reach) << i << ' ' << j;
        const double label = scalars[1].value_of(texel_at(patch.scalars[1], i, j));
        ASSERT_TRUE(label == 2.0 || label == 6.0) << label;
        ASSERT_TRUE(std::abs(p.y) < reach || label == label_at(p)) << label;
      }
    }
  }
  EXPECT_GT(samples, 100U);
}

TEST(TileScalars, AreThoseOfThePointsOnAllLevels) {
  const test::ScratchFolder folder;
  const Points points = torus_with_scalars();
  test::write_ply(folder / "torus.ply", points);
  const Status converted = convert_with({.all = true, .names = {}}, {}, folder);
  ASSERT_TRUE(converted) << converted.error().message;
  const auto tree = PatchTree::open(folder / "torus.relief");
  ASSERT_TRUE(tree) << tree.error().message;
  const std::vector<ScalarInfo>& scalars = tree->extent().scalars;
  ASSERT_EQ(scalars.size(), 2U);
  EXPECT_EQ(scalars[0].name, "ramp");
  EXPECT_FALSE(scalars[0].is_label);
  EXPECT_EQ(scalars[1].name, "classification");
  EXPECT_TRUE(scalars[1].is_label);
  // A torus of radii 1 and 0.4. Its quantiles are those of a sample of half of the points or more.
  EXPECT_NEAR(scalars[0].value_of(scalars[0].quantiles[0]), -1392.75, 10.0);
  EXPECT_NEAR(scalars[0].value_of(scalars[0].quantiles[50]), 7.25, 20.0);
  unsigned levels = 0;
  for (std::uint32_t t = 0; t < tree->tiles().size(); ++t) {
    const auto file = tree->open_tile(t);
    ASSERT_TRUE(file) << file.error().message;
    Progress progress;
    const auto model = file->read_all(progress);
    ASSERT_TRUE(model) << model.error().message;
    if (!model->patches.empty()) expect_scalars(*model, scalars, tree->tiles()[t].spacing);
    levels = std::max(levels, tree->tiles()[t].level + 1);
  }
  EXPECT_GE(levels, 2U);
  EXPECT_EQ(test::read_whole(folder / "torus.relief").scalars, scalars);
}

TEST(TileScalars, AreLeftOutUnlessTheyAreAskedFor) {
  const test::ScratchFolder folder;
  test::write_ply(folder / "torus.ply", torus_with_scalars());
  const Status converted = convert_with({}, {}, folder);
  ASSERT_TRUE(converted) << converted.error().message;
  EXPECT_TRUE(test::read_whole(folder / "torus.relief").scalars.empty());
}

TEST(TileScalars, WithoutANumberOrComputedAreRefused) {
  const test::ScratchFolder folder;
  test::write_ply(folder / "torus.ply", torus_with_scalars());
  const Status nothing = convert_with({.all = false, .names = {"nothing"}}, {}, folder);
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("its scalar 'nothing' has no finite number"),
            std::string::npos)
      << nothing.error().message;
  ConvertOptions distances;
  distances.distances = true;
  EXPECT_FALSE(convert_with({}, distances, folder));
  EXPECT_FALSE(std::filesystem::exists(folder / "torus.relief"));
}

}  // namespace
}  // namespace relief
