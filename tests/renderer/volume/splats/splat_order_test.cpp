// In which order footprints occlude one another: sheets, slabs and depths.
#include "renderer/volume/splats/splat_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

namespace relief {
namespace {

RayCamera camera_at(glm::dvec3 eye, glm::dvec3 target, double orthographic_height = 0.0) {
  const glm::dvec3 up =
      std::abs(glm::normalize(target - eye).y) > 0.99 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return ray_camera(make_view(Camera{eye, target, up, 45.0, orthographic_height}, 64, 64, 1e-6));
}

/// All nodes of a grid with spacing 1 whose first node is at 0.
KernelCloud grid_cloud(glm::uvec3 size) {
  KernelCloud cloud;
  cloud.size = size;
  for (std::uint32_t n = 0; n < size.x * size.y * size.z; ++n) {
    cloud.nodes.push_back(n);
    cloud.centres.emplace_back(n % size.x, n / size.x % size.y, n / (size.x * size.y));
  }
  return cloud;
}

/// A splat of each kernel, at its depth.
std::vector<PlacedSplat> placed(const KernelCloud& cloud, const RayCamera& camera) {
  std::vector<PlacedSplat> splats;
  for (std::uint32_t k = 0; k < cloud.count(); ++k) {
    Footprint footprint;
    footprint.depth = to_camera(camera, cloud.centres[k]).z;
    splats.push_back({footprint, k});
  }
  return splats;
}

std::vector<PlacedSplat> at_depths(const std::vector<double>& depths, double deviation = 0.0) {
  std::vector<PlacedSplat> splats;
  for (const double depth : depths) {
    Footprint footprint;
    footprint.depth = depth;
    footprint.depth_deviation = deviation;
    splats.push_back({footprint, static_cast<std::uint32_t>(splats.size())});
  }
  return splats;
}

void expect_ascending_groups(const SplatOrder& order) {
  EXPECT_TRUE(std::ranges::is_sorted(order.splats, {}, &OrderedSplat::group));
}

TEST(SplatOrder, SortedIsByDepthAndEqualsKeepTheCloudsOrder) {
  KernelCloud cloud;
  for (const double depth : {3.0, 1.0, 2.0, 1.0, 2.0, 1.0})
    cloud.centres.emplace_back(0.0, 0.0, depth);
  const RayCamera camera;  // at 0, along z
  const SplatOrder order =
      order_splats(cloud, placed(cloud, camera), VolumeVisibility::Sorted, camera, 0.0);
  std::vector<std::uint32_t> sequence;
  for (const OrderedSplat& splat : order.splats) sequence.push_back(splat.splat);
  EXPECT_EQ(sequence, (std::vector<std::uint32_t>{1, 3, 5, 2, 4, 0}));
  EXPECT_FALSE(order.has_slabs);
  for (std::uint32_t rank = 0; rank < 6; ++rank)
    EXPECT_EQ(order.splats[rank].group, rank) << "each occludes the next one by itself";
}

TEST(SplatOrder, NoSplatsHaveAnOrder) {
  for (const VolumeVisibility visibility :
       {VolumeVisibility::Sheet, VolumeVisibility::ImageSheet, VolumeVisibility::Sorted}) {
    const SplatOrder order =
        order_splats(grid_cloud({2, 2, 2}), {}, visibility, camera_at({9, 0, 0}, {}), 1.0);
    EXPECT_TRUE(order.splats.empty());
  }
}

TEST(SplatOrder, SheetsAreTheGridsPlanesThatAreMostParallelToTheImage) {
  const KernelCloud cloud = grid_cloud({3, 4, 5});
  const glm::dvec3 middle(1.0, 1.5, 2.0);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 away(0.3, 0.2, -0.25);
      away[axis] = side;
      for (const double height : {0.0, 8.0}) {
        const RayCamera camera = camera_at(middle + 20.0 * away, middle, height);
        SCOPED_TRACE(testing::Message() << axis << " from " << side << ", height " << height);
        EXPECT_EQ(sheet_axis(cloud, camera), axis);
        const auto splats = placed(cloud, camera);
        const SplatOrder order = order_splats(cloud, splats, VolumeVisibility::Sheet, camera, 1.0);
        ASSERT_EQ(order.splats.size(), cloud.count());
        expect_ascending_groups(order);
        const std::uint32_t last = cloud.size[axis] - 1;
        for (std::size_t s = 0; s < order.splats.size(); ++s) {
          const std::uint32_t sheet = cloud.node(order.splats[s].splat)[axis];
          EXPECT_EQ(order.splats[s].group, side > 0.0 ? last - sheet : sheet);
          if (s > 0 && order.splats[s].group == order.splats[s - 1].group) {
            EXPECT_LT(order.splats[s - 1].splat, order.splats[s].splat)
                << "the cloud's order within a sheet";
          }
        }
      }
    }
  }
}

// An eye among the sheets sees those of its one side in the image, and those behind it have no
// splats: either way the nearest one is the first.
TEST(SplatOrder, SheetsAboutAnEyeAmongThemAreOrderedByTheirDistance) {
  const KernelCloud cloud = grid_cloud({1, 1, 9});
  const RayCamera camera = camera_at({0.0, 0.0, 3.2}, {0.0, 0.0, 9.0});
  const SplatOrder order =
      order_splats(cloud, placed(cloud, camera), VolumeVisibility::Sheet, camera, 1.0);
  std::vector<std::uint32_t> sheets;
  for (const OrderedSplat& splat : order.splats) sheets.push_back(splat.splat);
  EXPECT_EQ(sheets, (std::vector<std::uint32_t>{3, 4, 2, 5, 1, 6, 0, 7, 8}));
}

TEST(SplatOrder, OfEquallyParallelPlanesThoseOfTheFirstAxisAreTaken) {
  KernelCloud cloud = grid_cloud({2, 2, 2});
  RayCamera camera;  // looks along z
  cloud.across = {{0.0, 0.6, 0.8}, {0.6, 0.0, 0.8}, {1.0, 0.0, 0.0}};
  EXPECT_EQ(sheet_axis(cloud, camera), 0);
  cloud.across = {{1.0, 0.0, 0.0}, {0.6, 0.0, -0.8}, {0.0, 0.6, 0.8}};
  EXPECT_EQ(sheet_axis(cloud, camera), 1);
}

TEST(SplatOrder, AutomaticIsSheetsOfAGridAndSortedOtherwise) {
  const KernelCloud grid = grid_cloud({2, 2, 2});
  const KernelCloud points;
  EXPECT_EQ(visibility_of(grid, VolumeVisibility::Automatic), VolumeVisibility::Sheet);
  EXPECT_EQ(visibility_of(points, VolumeVisibility::Automatic), VolumeVisibility::Sorted);
  EXPECT_EQ(visibility_of(points, VolumeVisibility::Sheet), VolumeVisibility::Sorted)
      << "points have no sheets";
  for (const VolumeVisibility wanted : {VolumeVisibility::ImageSheet, VolumeVisibility::Sorted}) {
    EXPECT_EQ(visibility_of(grid, wanted), wanted);
    EXPECT_EQ(visibility_of(points, wanted), wanted);
  }
}

TEST(SplatOrder, ASplatIsInEachSlabThatItReaches) {
  // Reaches are 3.5 deviations: 0.7 about 1, 2.05 and 5.
  const auto splats = at_depths({1.0, 2.05, 5.0}, 0.2);
  const SplatOrder order =
      order_splats({}, splats, VolumeVisibility::ImageSheet, camera_at({9, 0, 0}, {}), 1.0);
  EXPECT_TRUE(order.has_slabs);
  EXPECT_DOUBLE_EQ(order.thickness, 1.0);
  EXPECT_DOUBLE_EQ(order.first_depth, 0.3);
  expect_ascending_groups(order);
  std::vector<std::vector<std::uint32_t>> slabs(3);
  for (const OrderedSplat& splat : order.splats) slabs[splat.splat].push_back(splat.group);
  EXPECT_EQ(slabs[0], (std::vector<std::uint32_t>{0, 1}));  // 0.3 to 1.7
  EXPECT_EQ(slabs[1], (std::vector<std::uint32_t>{1, 2}));  // 1.35 to 2.75
  EXPECT_EQ(slabs[2], (std::vector<std::uint32_t>{4, 5}));  // 4.3 to 5.7
}

TEST(SplatOrder, ASplatThatLeansReachesMoreSlabs) {
  auto splats = at_depths({1.0, 9.0}, 0.2);
  splats[1].footprint.slope = {0.1, -0.2};
  splats[1].footprint.reach = {5.0, 5.0};  // 1.5 more to either side
  const SplatOrder order =
      order_splats({}, splats, VolumeVisibility::ImageSheet, camera_at({9, 0, 0}, {}), 1.0);
  const auto count = std::ranges::count(order.splats, 1U, &OrderedSplat::splat);
  EXPECT_EQ(count, 5);  // 6.8 to 11.2, from 0.3 on
}

// 3D Gaussians have no spacing, and slabs of theirs are as thick as their splats are deep.
TEST(SplatOrder, SlabsWithoutAThicknessAreFew) {
  std::vector<double> depths;
  for (int k = 0; k < 1000; ++k) depths.push_back(0.01 * k);
  const SplatOrder order = order_splats({}, at_depths(depths, 0.1), VolumeVisibility::ImageSheet,
                                        camera_at({9, 0, 0}, {}), 0.0);
  EXPECT_GE(order.splats.size(), 1000U);
  EXPECT_LE(order.splats.size(), 1000U * 65U) << "memory is bounded";
  EXPECT_GT(order.thickness, 0.0);
}

TEST(SplatOrder, SlabsOfAHostileDepthAreBounded) {
  auto splats = at_depths({1.0, 2.0, 3.0}, 0.1);
  splats[0].footprint.depth_deviation = 1e9;
  const SplatOrder one =
      order_splats({}, splats, VolumeVisibility::ImageSheet, camera_at({9, 0, 0}, {}), 1e-3);
  EXPECT_LE(one.splats.size(), 3U * 65U);
  expect_ascending_groups(one);
  // A depth without extent: 0 slabs thick.
  const SplatOrder flat = order_splats({}, at_depths({2.0, 2.0}), VolumeVisibility::ImageSheet,
                                       camera_at({9, 0, 0}, {}), 0.0);
  ASSERT_EQ(flat.splats.size(), 2U);
  EXPECT_EQ(flat.splats[0].group, flat.splats[1].group);
  EXPECT_GT(flat.thickness, 0.0) << "a slab holds the depth that its splats are at";
  EXPECT_LE(flat.first_depth, 2.0);
}

}  // namespace
}  // namespace relief
