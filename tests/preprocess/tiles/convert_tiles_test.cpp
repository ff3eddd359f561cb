// Conversions in tiles against those in memory.
#include "preprocess/convert_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>

#include "common/octahedral.h"
#include "preprocess/convert.h"
#include "preprocess/measure/measure.h"
#include "preprocess/tiles/spread_points.h"
#include "tests/common/patch_file/read_whole.h"
#include "tests/common/patch_file/sample_models.h"
#include "tests/common/seams/joined_mesh.h"
#include "tests/preprocess/noise/noisy_surfaces.h"
#include "tests/preprocess/readers/pack.h"
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
using test::tiles_of;
using test::try_convert;
using test::write_ply;

/// Of all points' distances to the patch that is nearest.
double psnr_of(const Points& points, const PatchModel& model) {
  double sum = 0.0;
  for (const glm::dvec3& p : points.positions) {
    double nearest = 1.0;
    for (const Patch& patch : model.patches)
      nearest = std::min(nearest, distance_to_patch(patch, p).value_or(1.0));
    sum += nearest * nearest;
  }
  const double diagonal = glm::distance(model.bounds.min, model.bounds.max);
  return 20.0 * std::log10(diagonal / std::sqrt(sum / static_cast<double>(points.size())));
}

/// Of all patches' samples the share whose normal is within a right angle of the surface's.
template <class Surface>
double share_facing(const PatchModel& model, const Surface& surface) {
  std::size_t facing = 0;
  std::size_t samples = 0;
  for (const Patch& patch : model.patches) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        ++samples;
        facing += glm::dot(patch.axes[2], surface.normal(position_of(patch, i, j))) > 0.0 ? 1 : 0;
      }
    }
  }
  return static_cast<double>(facing) / static_cast<double>(samples);
}

/// The distance of all patches' samples to a torus, rms.
double rms_off(const test::Torus& torus, const PatchModel& model) {
  double sum = 0.0;
  std::size_t samples = 0;
  for_each_position(model.patches, [&](const glm::dvec3& p) {
    sum += std::pow(torus.distance(p), 2.0);
    ++samples;
  });
  return std::sqrt(sum / static_cast<double>(samples));
}

TEST(ConvertTiles, GivesWhatAConversionInMemoryGives) {
  const ScratchFolder folder;
  const test::Torus torus;
  const Points points = test::sample_torus(torus, 0.02);  // 39,000
  write_ply(folder / "torus.ply", points);
  const TiledResult tiled = must_convert(folder / "torus.ply", folder / "torus.relief");
  EXPECT_GE(tiled.tiles, 10U);
  EXPECT_EQ(tiled.report.points, points.size());
  EXPECT_EQ(tiled.report.uncovered_points, 0U);
  const PatchModel model = read_whole(folder / "torus.relief");
  // Tiles are oriented each for itself, and half of them would be turned the wrong way by chance.
  EXPECT_EQ(share_facing(model, torus), 1.0);
  EXPECT_NEAR(model.bounding_radius, 1.4, 0.01);
  EXPECT_NEAR(model.spacing, 0.02, 0.002);
  EXPECT_EQ(folder.count(), 2) << "the parts are still there";
}

TEST(ConvertTiles, IsAsNearToThePointsAsAConversionInMemory) {
  const ScratchFolder folder;
  const Points points = test::sample_torus({}, 0.02);
  write_ply(folder / "torus.ply", points);
  Progress progress;
  ConvertOptions options;
  options.seams = false;  // psnr_of() knows nothing of what is between patches
  const auto tiled = convert_tiles({folder / "torus.ply"}, folder / "torus.relief", options, {},
                                   tiles_of(12000), progress);
  ASSERT_TRUE(tiled && *tiled);
  EXPECT_EQ((*tiled)->tiles, 4U);
  const double psnr = psnr_of(points, read_whole(folder / "torus.relief"));
  const auto in_memory = convert(points, options, progress);
  ASSERT_TRUE(in_memory);
  // Other patches of the same surface, some of them cut where tiles end and they are steep.
  EXPECT_NEAR(psnr, in_memory->report.psnr_db, 0.5);
  // Each tile is measured only against its own patches, which is less exact at its border.
  EXPECT_LE((*tiled)->report.psnr_db, psnr);
  EXPECT_GE((*tiled)->report.psnr_db, psnr - 1.0);

  options.seams = true;
  const auto tiles_meeting = convert_tiles({folder / "torus.ply"}, folder / "meeting.relief",
                                           options, {}, tiles_of(12000), progress);
  const auto meeting = convert(points, options, progress);
  ASSERT_TRUE(tiles_meeting && *tiles_meeting && meeting);
  EXPECT_GE((*tiles_meeting)->report.psnr_db, meeting->report.psnr_db - 1.5);
}

// Noise of half a spacing, 0.01, leaves a tenth to a fifth of itself on surfaces so smooth.
TEST(ConvertTiles, RemovesNoiseAsAConversionInMemoryDoes) {
  const ScratchFolder folder;
  const test::Torus torus;
  Points points = test::sample_torus(torus, 0.02);
  points.positions = test::with_noise({points.positions, 0.02}, 0.5);
  write_ply(folder / "torus.ply", points);
  const TiledResult tiled = must_convert(folder / "torus.ply", folder / "torus.relief");
  EXPECT_EQ(tiled.report.points_moved, points.size());
  EXPECT_NEAR(tiled.report.noise, 0.01, 0.001);
  EXPECT_NEAR(tiled.report.error_rms, 0.01, 0.001) << "of the points as scanned";
  EXPECT_LT(rms_off(torus, read_whole(folder / "torus.relief")), 0.002);

  ConvertOptions options;
  options.noise_removal = NoiseRemoval::None;
  const TiledResult kept = must_convert(folder / "torus.ply", folder / "torus.relief", options);
  EXPECT_EQ(kept.report.points_moved, 0U);
  EXPECT_GT(rms_off(torus, read_whole(folder / "torus.relief")), 0.006);
}

TEST(ConvertTiles, LeavesStrayPointsOut) {
  const ScratchFolder folder;
  Points points = test::sample_torus({}, 0.02);
  const std::size_t scanned = points.size();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
  while (points.size() < scanned + 1000) {
    const glm::dvec3 p(anywhere(random), anywhere(random), anywhere(random));
    // Twice, as points that were measured many times.
    if (std::abs(test::Torus{}.distance(p)) > 0.1)
      points.positions.insert(points.positions.end(), 2, p);
  }
  write_ply(folder / "torus.ply", points);
  const TiledResult tiled = must_convert(folder / "torus.ply", folder / "torus.relief");
  // Some lie together by chance; one piece leaves as many.
  EXPECT_GE(tiled.report.stray_points, 495U);
  EXPECT_EQ(tiled.duplicates, 500U);
  EXPECT_LT(rms_off({}, read_whole(folder / "torus.relief")), 0.01);
}

// A piece of a torus' surface is open, so that its own outside may well be the torus' inside.
TEST(ConvertTiles, GivenNormalsAreFollowed) {
  const ScratchFolder folder;
  const test::Torus torus;
  Points points = test::sample_torus(torus, 0.02);
  for (const glm::dvec3& p : points.positions) points.normals.emplace_back(-torus.normal(p));
  write_ply(folder / "torus.ply", points);
  must_convert(folder / "torus.ply", folder / "torus.relief");
  EXPECT_EQ(share_facing(read_whole(folder / "torus.relief"), torus), 0.0);
}

/// A plane of two by two, waved, whose middle is cut by tiles' borders.
TEST(ConvertTiles, BordersOfTilesShowNoSeam) {
  const ScratchFolder folder;
  const auto height = [](double x, double y) {
    return 0.05 * std::sin(5.0 * x) * std::cos(4.0 * y);
  };
  const Points points = test::sample_height_field(1.0, 0.01, height);
  write_ply(folder / "waves.ply", points);
  const TiledResult tiled = must_convert(folder / "waves.ply", folder / "waves.relief");
  EXPECT_GE(tiled.tiles, 8U);
  const PatchModel model = read_whole(folder / "waves.relief");
  // Over each spot but the rim there is a cell of four samples, of one patch or another.
  std::size_t bare = 0;
  double worst = 0.0;
  for (double y = -0.98; y < 0.98; y += 0.004) {
    for (double x = -0.98; x < 0.98; x += 0.004) {
      const glm::dvec3 p(x, y, height(x, y));
      double nearest = 1.0;
      for (const Patch& patch : model.patches) {
        const glm::dvec3 local = glm::transpose(patch.axes) * (p - patch.origin) / patch.spacing;
        const auto i = static_cast<std::int64_t>(std::floor(local.x));
        const auto j = static_cast<std::int64_t>(std::floor(local.y));
        if (i < 0 || j < 0 || i + 1 >= patch.width || j + 1 >= patch.height) continue;
        double sum = 0.0;
        bool whole = true;
        for (const int di : {0, 1}) {
          for (const int dj : {0, 1}) {
            const std::int32_t h =
                patch.at(static_cast<std::uint32_t>(i + di), static_cast<std::uint32_t>(j + dj));
            whole = whole && h != kHole;
            const double fx = local.x - static_cast<double>(i);
            const double fy = local.y - static_cast<double>(j);
            sum += (di == 1 ? fx : 1.0 - fx) * (dj == 1 ? fy : 1.0 - fy) * h * patch.height_step;
          }
        }
        if (whole) nearest = std::min(nearest, std::abs(local.z * patch.spacing - sum));
      }
      bare += nearest == 1.0 ? 1 : 0;
      if (nearest < 1.0) worst = std::max(worst, nearest);
    }
  }
  EXPECT_EQ(bare, 0U);
  // Half a height step of 0.0005, and chords of cells 0.01 wide over waves that bend
  // by 1.25: 1.6e-5 and as much again for the slope of patches' planes.
  EXPECT_LT(worst, 0.0004);
}

/// Marks the spots of a square grid, `spots` a side, that a triangle lies over.
void mark_covered(const std::array<glm::dvec3, 3>& t, double low, double step, std::size_t spots,
                  std::vector<std::uint8_t>& covered) {
  const auto range = [&](glm::length_t axis) {
    const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil((least - low) / step)));
    const auto last = static_cast<std::size_t>(std::max(0.0, std::floor((most - low) / step) + 1));
    return std::pair(first, std::min(last, spots));
  };
  for (std::size_t j = range(1).first; j < range(1).second; ++j) {
    for (std::size_t i = range(0).first; i < range(0).second; ++i) {
      const glm::dvec2 p(low + static_cast<double>(i) * step, low + static_cast<double>(j) * step);
      bool inside = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const glm::dvec2 side(t[(c + 1) % 3] - t[c]);
        const glm::dvec2 to = p - glm::dvec2(t[c]);
        inside = inside && side.x * to.y - side.y * to.x >= -1e-12;
      }
      if (inside) covered[j * spots + i] = 1;
    }
  }
}

// Within a tile patches meet, from tile to tile they overlap.
TEST(ConvertTiles, PatchesThatMeetLeaveNoGapAtBordersOfTiles) {
  const ScratchFolder folder;
  const auto height = [](double x, double y) {
    return 0.05 * std::sin(5.0 * x) * std::cos(4.0 * y);
  };
  write_ply(folder / "waves.ply", test::sample_height_field(1.0, 0.01, height));
  ConvertOptions options;
  options.cone_degrees = 10.0;  // several patches a tile
  options.seams = true;
  const TiledResult tiled = must_convert(folder / "waves.ply", folder / "waves.relief", options);
  EXPECT_GE(tiled.tiles, 8U);
  EXPECT_EQ(tiled.report.uncovered_points, 0U);
  const PatchModel model = read_whole(folder / "waves.relief");
  EXPECT_EQ(model.joined.size(), tiled.tiles);
  EXPECT_GT(model.patches.size(), 2 * tiled.tiles);
  constexpr std::size_t spots = 491;
  constexpr double step = 0.004;
  std::vector<std::uint8_t> covered(spots * spots, 0);
  for (const PatchRun& run : model.joined) {
    const test::JoinedMesh mesh =
        test::joined_mesh(std::span(model.patches).subspan(run.first, run.count));
    for (const Triangle& t : mesh.triangles) {
      mark_covered({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, -0.98, step,
                   spots, covered);
    }
  }
  // Of 241,081; 1,071 without margins. One is known: two borders lie on one line there, and no
  // triangle between them is round enough (decision 0100).
  EXPECT_LE(std::ranges::count(covered, 0), 1);
}

TEST(ConvertTiles, BytesDoNotDependOnThreadsOrLeftoverFiles) {
  const ScratchFolder folder;
  Points points = test::sample_torus({}, 0.02);
  for (const glm::dvec3& p : points.positions)
    points.colours.emplace_back(127.0 + 80.0 * p.x, 127.0 + 80.0 * p.y, 127.0 + 200.0 * p.z);
  points.positions.push_back(points.positions.front());  // a duplicate
  points.colours.push_back(points.colours.front());
  write_ply(folder / "torus.ply", points);
  for (const bool seams : {false, true}) {
    ConvertOptions options;
    options.seams = seams;
    options.threads = 1;
    const TiledResult one = must_convert(folder / "torus.ply", folder / "one.relief", options);
    EXPECT_EQ(one.duplicates, 1U);
    const std::string expected = slurp(folder / "one.relief");
    for (const int threads : {2, 4}) {
      options.threads = threads;
      must_convert(folder / "torus.ply", folder / "other.relief", options);
      EXPECT_TRUE(slurp(folder / "other.relief") == expected) << threads << " " << seams;
    }
  }
}

TEST(ConvertTiles, CompactFilesAreTheSamePatches) {
  const ScratchFolder folder;
  write_ply(folder / "torus.ply", test::sample_torus({}, 0.02));
  must_convert(folder / "torus.ply", folder / "fast.relief");
  PatchFileOptions compact;
  compact.codec = PatchCodec::Compact;
  must_convert(folder / "torus.ply", folder / "compact.relief", {}, compact);
  const PatchModel a = read_whole(folder / "fast.relief");
  const PatchModel b = read_whole(folder / "compact.relief");
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t p = 0; p < a.patches.size(); ++p)
    EXPECT_EQ(a.patches[p].heights, b.patches[p].heights) << p;
}

TEST(ConvertTiles, ScansThatFitAreConvertedInOnePiece) {
  const ScratchFolder folder;
  write_ply(folder / "torus.ply", test::sample_torus({}, 0.03));  // 17,000
  Progress progress;
  const auto result = try_convert(folder / "torus.ply", folder / "torus.relief", progress);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_FALSE(*result);
  EXPECT_EQ(folder.count(), 1);
}

TEST(ConvertTiles, PointsThatCannotBeCutApartAreRefused) {
  const ScratchFolder folder;
  Points points = test::sample_torus({}, 0.05);
  points.positions.insert(points.positions.end(), 30000, glm::dvec3(1.4, 0.0, 0.0));
  write_ply(folder / "torus.ply", points);
  Progress progress;
  const auto result = try_convert(folder / "torus.ply", folder / "torus.relief", progress);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("too near to each other to be cut apart"),
            std::string::npos)
      << result.error().message;
  EXPECT_EQ(folder.count(), 1);
}

TEST(ConvertTiles, UnreadableFilesLeaveNothingBehind) {
  const ScratchFolder folder;
  Progress progress;
  EXPECT_FALSE(try_convert(folder / "none.ply", folder / "a.relief", progress));
  spill(folder / "bad.ply", "ply\nformat ascii 1.0\nelement vertex 5\n");
  EXPECT_FALSE(try_convert(folder / "bad.ply", folder / "a.relief", progress));
  EXPECT_EQ(folder.count(), 1);
}

}  // namespace
}  // namespace relief
