// Coarser levels of patches: what they hold, which a view chooses, and their images.
#include "renderer/geometry/cells/levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/renderer/images.h"

namespace relief {
namespace {

/// A plane of slopes 1/2 and 1/4 with holes scattered in it; a height step is 2^-10 cells, so that
/// all heights are exact.
Patch tattered_plane(std::uint32_t width, std::uint32_t height, double share_of_holes) {
  std::mt19937 random(3);
  std::bernoulli_distribution is_hole(share_of_holes);
  Patch patch;
  patch.width = width;
  patch.height = height;
  patch.height_step = std::ldexp(1.0, -10);
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t i = 0; i < width; ++i)
      patch.heights.push_back(is_hole(random) ? kHole
                                              : static_cast<std::int32_t>(512 * i + 256 * j));
  }
  return patch;
}

TEST(Levels, CellsOverEverySampleAndOnTheSurface) {
  const Patch patch = tattered_plane(37, 22, 0.2);
  for (const std::uint32_t level : {1U, 2U, 3U}) {
    const PatchLevel coarse = coarsen(patch, level);
    const Patch& grid = coarse.grid;
    const std::int64_t stride = 1U << level;
    const auto height_at = [&](std::uint32_t i, std::uint32_t j) {
      return grid.at(i, j) * grid.height_step + grid.origin.z;
    };
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        // All four cells around a sample that lies on a node, two on an edge, one within.
        for (const std::int64_t y : {j + stride - 1, j + stride}) {
          for (const std::int64_t x : {i + stride - 1, i + stride}) {
            const auto a = static_cast<std::uint32_t>(x / stride);
            const auto b = static_cast<std::uint32_t>(y / stride);
            for (const auto& [c, d] : {std::pair{a, b}, {a + 1, b}, {a, b + 1}, {a + 1, b + 1}})
              EXPECT_NE(grid.at(c, d), kHole) << level << ": " << i << " " << j;
          }
        }
        if (i % stride == 0 && j % stride == 0) {
          EXPECT_EQ(height_at(static_cast<std::uint32_t>(i / stride) + 1,
                              static_cast<std::uint32_t>(j / stride) + 1),
                    patch.at(i, j) * patch.height_step);
        }
      }
    }
  }
}

TEST(Levels, ContinueAPlaneBeyondItsBorder) {
  const Patch patch = tattered_plane(21, 17, 0.0);
  for (const std::uint32_t level : {1U, 2U, 3U}) {
    const Patch grid = coarsen(patch, level).grid;
    const double stride = std::ldexp(1.0, static_cast<int>(level));
    EXPECT_EQ(grid.spacing, stride);
    EXPECT_EQ(grid.width, (21 - 1) / (1U << level) + 3);
    for (std::uint32_t j = 0; j < grid.height; ++j) {
      for (std::uint32_t i = 0; i < grid.width; ++i) {
        const double x = (i - 1.0) * stride;
        const double y = (j - 1.0) * stride;
        // Nothing is more than a coarse cell away, and all of it is far enough from the other side.
        ASSERT_NE(grid.at(i, j), kHole);
        EXPECT_EQ(grid.origin.z + grid.at(i, j) * grid.height_step, 0.5 * x + 0.25 * y)
            << level << ": " << i << " " << j;
      }
    }
    EXPECT_EQ(grid.origin.x, -stride);
    EXPECT_EQ(grid.origin.y, -stride);
  }
}

TEST(Levels, ACellIsWholeIfNoHoleIsInIt) {
  Patch patch = tattered_plane(9, 9, 0.0);
  patch.heights[3 * 9 + 5] = kHole;  // within the cell from (4, 2) to (6, 4) of level 1
  const PatchLevel coarse = coarsen(patch, 1);
  for (std::uint32_t j = 0; j < coarse.grid.height; ++j) {
    for (std::uint32_t i = 0; i < coarse.grid.width; ++i) {
      const bool inside = i >= 1 && j >= 1 && i <= 4 && j <= 4;
      EXPECT_EQ(coarse.whole[j * coarse.grid.width + i] != 0, inside && !(i == 3 && j == 2))
          << i << " " << j;
    }
  }
}

TEST(Levels, AreChosenByTheNearestSpacing) {
  // 100 pixels for 45 degrees: a world unit at depth 1 is 100 / (2 tan 22.5) = 120.7 pixels.
  const Camera camera{{0.0, 0.0, 11.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  View view = make_view(camera, 100, 100, 0.01);
  const PatchExtent extent{{0.0, 0.0, 0.0}, 1.0, 0.1, 5};  // nearest at depth 10: 1.207 pixels
  for (const auto& [pixels, level] : {std::pair{0.0, 0U},
                                      {1.0, 0U},
                                      {2.4, 0U},
                                      {2.42, 1U},
                                      {4.82, 1U},
                                      {4.83, 2U},
                                      {1000.0, 4U}}) {
    view.pixels_per_sample = pixels;
    EXPECT_EQ(choose_level(view, extent), level) << pixels;
  }
  // Around the eye there is no limit to how large a spacing is seen.
  view.pixels_per_sample = 1000.0;
  EXPECT_EQ(choose_level(view, {{0.0, 0.0, 10.5}, 1.0, 0.1, 5}), 0U);
}

/// One row of waves of 16 cells, as high as that is wide.
Patch wave(double height_step) {
  Patch patch = tattered_plane(65, 33, 0.0);
  patch.height_step = height_step;
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const double turns = i / 16.0;
      patch.heights[j * patch.width + i] =
          static_cast<std::int32_t>(std::lround(8000.0 * (1.0 + std::sin(6.2831853 * turns))));
    }
  }
  return patch;
}

TEST(Levels, HaveTheErrorOfTheSamplesBetweenTheirOwn) {
  EXPECT_EQ(level_error(tattered_plane(65, 33, 0.0), 2), 0.0);
  const Patch patch = wave(0.001);
  // Every other sample lies on level 1, the others 1 - cos(2 pi / 16) of the wave off it; of a wave
  // of height 8 the root mean square is 8 / sqrt(2). Heights are rounded to 0.001.
  const double chord = 1.0 - std::cos(6.2831853 / 16.0);
  EXPECT_NEAR(*level_error(patch, 1), 8.0 / std::sqrt(2.0) * chord * std::sqrt(0.5), 0.001);
  // Holes are not counted, nor the cells that lack a corner.
  EXPECT_NEAR(*level_error(tattered_plane(65, 33, 0.1), 3), 0.0, 1e-9);
  EXPECT_FALSE(level_error(tattered_plane(3, 2, 0.0), 1));
}

TEST(Levels, AreChosenByTheirErrorsToo) {
  const Camera camera{{0.0, 0.0, 1000.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  View view = make_view(camera, 100, 100, 0.01);
  view.pixels_per_sample = 4.0;
  const Patch patch = wave(0.001);
  PatchExtent extent = extent_of(patch);
  measure_levels(patch, extent.levels - 1, extent);
  EXPECT_EQ(extent.measured, 6U);
  EXPECT_LT(extent.errors[1], extent.errors[2]);
  EXPECT_LT(extent.errors[2], extent.errors[3]);
  // As far away as level 2 is off by as much as it may be, by how high a pixel is there.
  const auto level_where_it_may_be_off_by = [&](double error) {
    const double pixel = error / (kMostLevelError * view.pixels_per_sample);
    view.eye.z = extent.centre.z + extent.radius + pixel / pixel_at(view, 1.0);
    return choose_level(view, extent);
  };
  view.pixels_per_sample = 4000.0;  // what the spacing allows is coarser
  EXPECT_EQ(level_where_it_may_be_off_by(1.01 * extent.errors[2]), 2U);
  EXPECT_EQ(level_where_it_may_be_off_by(0.99 * extent.errors[2]), 1U);
  EXPECT_EQ(level_where_it_may_be_off_by(0.99 * extent.errors[1]), 0U);
}

TEST(Levels, WithoutCellsAreOffByFourTimesAsMuch) {
  const Patch patch = tattered_plane(3, 2, 0.0);
  PatchExtent extent = extent_of(patch);
  measure_levels(patch, 2, extent);
  EXPECT_EQ(extent.errors[1], patch.spacing);
  EXPECT_EQ(extent.errors[2], 4.0 * patch.spacing);
}

TEST(Levels, AreChosenByTheSpacingAtAnyDepthOfAnOrthographicImage) {
  Camera camera{{0.0, 0.0, 11.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  camera.orthographic_height = 8.0;
  View view = make_view(camera, 100, 100, 0.01);  // a spacing of 0.1 is 1.25 pixels
  for (const double z : {0.0, 10.5, -1000.0}) {
    const PatchExtent extent{{0.0, 0.0, z}, 1.0, 0.1, 5};
    for (const auto& [pixels, level] :
         {std::pair{2.4, 0U}, {2.51, 1U}, {4.9, 1U}, {5.01, 2U}, {1000.0, 4U}}) {
      view.pixels_per_sample = pixels;
      EXPECT_EQ(choose_level(view, extent), level) << pixels << " " << z;
    }
  }
}

TEST(Levels, OfAPatchAsLongAsItIsWide) {
  EXPECT_EQ(extent_of(tattered_plane(1, 1, 0.0)).levels, 1U);
  EXPECT_EQ(extent_of(tattered_plane(3, 2, 0.0)).levels, 2U);
  EXPECT_EQ(extent_of(tattered_plane(17, 2, 0.0)).levels, 5U);
  EXPECT_EQ(extent_of(tattered_plane(1000, 2, 0.0)).levels, kMaxLevels);
}

class LevelImages : public testing::TestWithParam<test::Method> {};

RenderSettings settings_of(const PatchModel& model, const test::Method& method, double pixels) {
  RenderSettings settings = test::small_image(model, {30.0, 20.0, 0.0});
  settings.outputs = test::all_outputs();
  settings.primitive = method.primitive;
  settings.interpolation = method.interpolation;
  settings.pixels_per_sample = pixels;
  return settings;
}

// A sphere is as closed at every level as at the finest, and its depth off by no more than a chord:
// half a coarse cell squared over twice the radius, and what splats of border samples stick out.
TEST_P(LevelImages, OfASphereAreClosed) {
  test::SphereShape shape;
  shape.spacing = 0.02;
  const PatchModel model = test::sphere_model(shape);
  const auto render_at = [&](double height, double pixels) {
    RenderSettings settings = settings_of(model, GetParam(), pixels);
    settings.camera.orthographic_height = height;
    return test::must_render(model, settings);
  };
  // Perspective; and orthographic, where all of the sphere is as coarse as allowed: both at
  // level 2.
  for (const auto& [height, pixels] :
       {std::pair{0.0, 4.0}, {0.0, 8.0}, {0.0, 16.0}, {2.2, 4.0}, {1.1, 8.0}}) {
    const RenderResult finest = render_at(height, 0.0);
    const RenderResult coarse = render_at(height, pixels);
    std::size_t covered = 0;
    std::size_t holes = 0;
    std::size_t far = 0;
    const auto& depth = test::values(finest.image, "Z");
    for (std::size_t k = 0; k < depth.size(); ++k) {
      if (!std::isfinite(depth[k])) continue;
      ++covered;
      const double behind = test::values(coarse.image, "Z")[k] - depth[k];
      if (!(behind < 0.5 * shape.radius)) ++holes;
      if (!(std::abs(behind) < 0.05 * shape.radius)) ++far;
    }
    EXPECT_GT(covered, 5000U);
    // The silhouette of a polyhedron lies within that of the sphere: a pixel around at most.
    EXPECT_LT(holes, covered / 100) << pixels;
    EXPECT_LT(far, covered / 50) << pixels;
  }
}

// On bumps as high as ten samples are apart a level is off by more than 1/8 of a pixel: the
// finest is drawn, but of patches that overlap, whose margins are farther off.
TEST(Levels, OfPatchesThatMeetAreNotSeen) {
  test::SphereShape shape;
  shape.spacing = 0.02;
  shape.patches_per_side = 2;
  shape.bumps = 0.2;
  PatchModel model = test::sphere_model(shape);
  for (const bool meet : {true, false}) {
    if (meet) {
      model.joined = {{0, static_cast<std::uint32_t>(model.patches.size()), true}};
    } else {
      model.joined.clear();
    }
    RenderSettings settings =
        settings_of(model, {Primitive::Cell, Interpolation::Corrected, "cell"}, 16.0);
    // Samples are four pixels apart, and the sphere is 400 wide: smaller ones are proxies.
    settings.camera.orthographic_height = 0.5;
    const RenderResult chosen = test::must_render(model, settings);
    settings.pixels_per_sample = 0.0;
    const RenderResult finest = test::must_render(model, settings);
    std::size_t different = 0;
    for (std::size_t k = 0; k < test::values(finest.image, "Z").size(); ++k) {
      const float depth = test::values(finest.image, "Z")[k];
      different += std::isfinite(depth) && depth != test::values(chosen.image, "Z")[k] ? 1 : 0;
    }
    EXPECT_EQ(different > 0, !meet);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LevelImages, testing::ValuesIn(test::all_methods()),
                         [](const auto& method) { return std::string(method.param.name); });

}  // namespace
}  // namespace relief
