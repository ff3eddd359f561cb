// Coarser point sets, and images that are refined while time remains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/engines/ewa/render_ewa.h"
#include "renderer/engines/ewa/splat_hierarchy.h"
#include "tests/renderer/engines/ewa/ewa_clouds.h"
#include "tests/renderer/images.h"

namespace relief::ewa {
namespace {

using test::ewa_image;
using test::must_splat;
using test::values;

TEST(SplatLevels, KeepThePointsAreaAndShrink) {
  const SplatHierarchy hierarchy = build_hierarchy(test::sphere_cloud(30000));
  ASSERT_GE(hierarchy.levels.size(), 4U);
  double area = 0.0;
  std::size_t points = 1000000;
  for (const SplatCloud& level : hierarchy.levels) {
    EXPECT_LT(level.positions.size(), points);
    points = level.positions.size();
    double sum = 0.0;
    for (const double radius : level.radii) sum += radius * radius;
    EXPECT_GE(sum, area * (1.0 - 1e-12));  // rounding
    area = sum;
  }
  EXPECT_LT(points, 1000U);
}

TEST(SplatLevels, NoLevelHasHoles) {
  const SplatHierarchy plane = build_hierarchy(test::plane_cloud(100, 100));
  ASSERT_GE(plane.levels.size(), 4U);
  for (const SplatCloud& level : plane.levels) {
    const RenderResult result = must_splat(level, ewa_image({1.0, -40.0, 80.0}));
    for (const float alpha : values(result.image, "A")) ASSERT_EQ(alpha, 1.0F);
  }
  // The sphere's silhouette at this distance is 37 pixels from the middle; within 25 there is
  // nothing but surface.
  const SplatHierarchy sphere = build_hierarchy(test::sphere_cloud(30000));
  for (const SplatCloud& level : sphere.levels) {
    const RenderResult result = must_splat(level, ewa_image({0.0, 0.0, 3.7}));
    for (std::size_t k = 0; k < std::size_t{96} * 96; ++k) {
      const std::size_t row = k / 96;
      const double x = static_cast<double>(k - row * 96) - 47.5;
      const double y = static_cast<double>(row) - 47.5;
      if (std::hypot(x, y) >= 25.0) continue;
      ASSERT_GT(values(result.image, "A")[k], 0.999F);
    }
  }
}

TEST(SplatLevels, FinerLevelsComeCloserToTheFullImage) {
  const SplatHierarchy hierarchy = build_hierarchy(test::sphere_cloud(30000));
  const RenderSettings settings = ewa_image({0.0, 0.0, 3.7});
  const RenderResult full = must_splat(hierarchy.levels[0], settings);
  double last = 0.0;
  for (std::size_t level = 1; level < hierarchy.levels.size(); ++level) {
    const RenderResult result = must_splat(hierarchy.levels[level], settings);
    double difference = 0.0;
    for (std::size_t k = 0; k < std::size_t{96} * 96; ++k)
      difference += std::abs(values(result.image, "G")[k] - values(full.image, "G")[k]);
    EXPECT_GT(difference, last) << level;
    last = difference;
  }
}

TEST(SplatLevels, TwoSidesOfASheetStayApart) {
  SplatCloud cloud = test::plane_cloud(20, 20, 0.0, {1.0F, 0.0F, 0.0F, 1.0F});
  SplatCloud back = test::plane_cloud(20, 20, -0.01, {0.0F, 1.0F, 0.0F, 1.0F});
  for (glm::vec3& normal : back.normals) normal = -normal;
  test::append(cloud, back);
  const SplatHierarchy hierarchy = build_hierarchy(cloud);
  for (const SplatCloud& level : hierarchy.levels) {
    for (std::size_t k = 0; k < level.positions.size(); ++k) {
      EXPECT_EQ(std::abs(level.normals[k].z), 1.0F);
      EXPECT_EQ(level.colours[k].r, level.normals[k].z > 0.0F ? 1.0F : 0.0F);
    }
  }
}

TEST(SplatLevels, LevelsAreChosenByTheSizeOfTheirSplats) {
  const SplatHierarchy hierarchy = build_hierarchy(test::plane_cloud(100, 100));
  const auto level_at = [&](double pixels) {
    const RenderSettings s = ewa_image({0.0, 0.0, test::distance_for(pixels)});
    return level_of_size(hierarchy, make_view(s.camera, s.width, s.height, 0.01), kFinestPixels);
  };
  // Clusters of 2 x 2 points have at least twice their radius, those of 4 x 4 four times.
  EXPECT_EQ(level_at(1.0), 0U);
  EXPECT_EQ(level_at(0.3), 0U);
  EXPECT_EQ(level_at(0.2), 1U);
  EXPECT_EQ(level_at(0.1), 2U);
}

TEST(SplatLevels, ImagesAreRefinedWhileTimeRemains) {
  const SplatHierarchy hierarchy = build_hierarchy(test::sphere_cloud(30000));
  RenderSettings settings = ewa_image({0.0, 0.0, 3.7});
  Progress silent;
  EnvironmentCache environments;
  ClipCache clips({});
  for (const double budget : {1e-9, 1e9}) {
    settings.ewa.time_budget_ms = budget;
    std::vector<std::uint32_t> shown;
    const auto show = [&shown](const RenderResult& image) { shown.push_back(*image.level); };
    const auto last = render_progressive(hierarchy, environments, clips, settings, show, silent);
    ASSERT_TRUE(last);
    // Radii of 0.6 pixels, or 1.2, 2.5 and 5.
    const std::uint32_t coarsest = 2;
    ASSERT_FALSE(shown.empty());
    EXPECT_EQ(shown.front(), coarsest);
    EXPECT_EQ(shown.back(), budget < 1.0 ? coarsest : 0U);
    EXPECT_TRUE(std::is_sorted(shown.rbegin(), shown.rend()));
    settings.ewa.time_budget_ms = 0.0;
    const RenderResult plain = must_splat(hierarchy.levels[shown.back()], settings);
    EXPECT_EQ(values(last->image, "G"), values(plain.image, "G"));
  }
}

TEST(SplatLevels, RefinementEndsAtHalfAPixel) {
  const SplatHierarchy hierarchy = build_hierarchy(test::plane_cloud(100, 100));
  RenderSettings settings = ewa_image({0.0, 0.0, test::distance_for(0.2)});
  settings.ewa.time_budget_ms = 1e9;
  Progress silent;
  EnvironmentCache environments;
  ClipCache clips({});
  const auto last = render_progressive(
      hierarchy, environments, clips, settings, [](const RenderResult&) {}, silent);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->level, 1U);  // see above
}

}  // namespace
}  // namespace relief::ewa
