// Clouds of PCL in, patches out, clouds back.
#include "integrations/pcl.h"

#include <gtest/gtest.h>

#include <limits>

#include "preprocess/convert.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <class Point>
Point point_at(float x, float y, float z) {
  Point p;
  p.x = x;
  p.y = y;
  p.z = z;
  return p;
}

template <class Point>
class PclPoints : public testing::Test {};
using PointTypes =
    testing::Types<pcl::PointXYZ, pcl::PointXYZRGB, pcl::PointNormal, pcl::PointXYZRGBNormal>;
TYPED_TEST_SUITE(PclPoints, PointTypes);

// Values that single precision holds exactly come through unchanged.
TYPED_TEST(PclPoints, ComeInWithWhatTheirTypeHas) {
  pcl::PointCloud<TypeParam> cloud;
  for (int k = 0; k < 3; ++k) {
    auto p = point_at<TypeParam>(0.5F * static_cast<float>(k), 1.0F, -2.0F);
    if constexpr (HasPclNormal<TypeParam>) p.normal_z = -1.0F;
    if constexpr (HasPclColour<TypeParam>) {
      p.r = 10;
      p.g = 20;
      p.b = static_cast<std::uint8_t>(30 + k);
    }
    cloud.push_back(p);
  }
  const Points points = points_of_pcl(cloud);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points.positions[2], glm::dvec3(1.0, 1.0, -2.0));
  EXPECT_EQ(points.normals.size(), HasPclNormal<TypeParam> ? 3U : 0U);
  for (const glm::vec3& normal : points.normals) EXPECT_EQ(normal, glm::vec3(0.0F, 0.0F, -1.0F));
  EXPECT_EQ(points.colours.size(), HasPclColour<TypeParam> ? 3U : 0U);
  if (HasPclColour<TypeParam>) {
    EXPECT_EQ(points.colours[1], glm::u8vec3(10, 20, 31));
  }
}

TYPED_TEST(PclPoints, ComeBackWithWhatTheirTypeHas) {
  Points sphere = test::sample_sphere(2'000);
  sphere.colours.assign(sphere.size(), glm::u8vec3(200, 100, 50));
  Progress progress;
  const auto converted = convert(std::move(sphere), {}, progress);
  ASSERT_TRUE(converted) << converted.error().message;
  const auto cloud = pcl_of_patches<TypeParam>(converted->model);
  ASSERT_TRUE(cloud) << cloud.error().message;
  EXPECT_EQ(cloud->size(), count_samples(converted->model));
  EXPECT_TRUE(cloud->is_dense);
  for (const TypeParam& p : *cloud) {
    const glm::vec3 position(p.x, p.y, p.z);
    // Chords of 16 neighbours of a sphere of 2,000 points are up to 0.006 below it, and so are
    // samples of a margin.
    EXPECT_NEAR(glm::length(position), 1.0F, 0.01F);
    if constexpr (HasPclNormal<TypeParam>) {
      EXPECT_GT(glm::dot(glm::vec3(p.normal_x, p.normal_y, p.normal_z), position), 0.98F);
    }
    if constexpr (HasPclColour<TypeParam>) {
      EXPECT_EQ(glm::ivec3(p.r, p.g, p.b), glm::ivec3(200, 100, 50));
    }
  }
}

TEST(PclCloud, LosesWhatIsNoNumberAndWhatIsThereTwice) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.push_back({1.0F, 2.0F, 3.0F});
  cloud.push_back({kNaN, kNaN, kNaN});
  cloud.push_back({1.0F, 2.0F, 3.0F});
  cloud.push_back({4.0F, 5.0F, 6.0F});
  EXPECT_EQ(points_of_pcl(cloud).size(), 2U);
}

// A survey's coordinates in a cloud of single precision, less an offset: 0.25 m without it.
TEST(PclCloud, KeepsMillimetresOfASurveyByItsOffset) {
  const glm::dvec3 offset(515'384.0, 4'918'360.0, 2'330.0);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const glm::dvec3& p : test::sample_sphere(2'000).positions)
    cloud.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  Points points = points_of_pcl(cloud, offset);
  ASSERT_EQ(points.size(), cloud.size());
  EXPECT_EQ(points.positions[7] - offset, glm::dvec3(cloud[7].x, cloud[7].y, cloud[7].z));

  Progress progress;
  const auto converted = convert(std::move(points), {}, progress);
  ASSERT_TRUE(converted) << converted.error().message;
  const auto back = pcl_of_patches<pcl::PointXYZ>(converted->model, offset);
  ASSERT_TRUE(back) << back.error().message;
  std::size_t k = 0;
  for_each_position(converted->model.patches, [&](glm::dvec3 position) {
    const pcl::PointXYZ& p = (*back)[k++];
    // Half the last bit of coordinates up to 1.01 of a unit, and as much of double precision at
    // 5e6.
    EXPECT_LT(glm::distance(glm::dvec3(p.x, p.y, p.z) + offset, position), 1.2e-7);
  });
  EXPECT_EQ(k, back->size());
}

/// A wall two units ahead of a camera, in the camera's own axes.
pcl::PointCloud<pcl::PointXYZ> camera_frame() {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int row = -10; row <= 10; ++row) {
    for (int column = -10; column <= 10; ++column)
      cloud.push_back({0.1F * static_cast<float>(column), 0.1F * static_cast<float>(row), 2.0F});
  }
  cloud.width = 21;
  cloud.height = 21;
  return cloud;
}

TEST(PclSensor, OfAnOrganisedCloudIsWhereTheCameraWas) {
  const Points points = points_of_pcl(camera_frame());
  ASSERT_TRUE(points.viewpoint);
  EXPECT_EQ(*points.viewpoint, glm::dvec3(0.0));
  ASSERT_TRUE(points.stance);
  EXPECT_TRUE(points.stance->is_from_sensor);
  EXPECT_EQ(points.stance->up, glm::dvec3(0.0, -1.0, 0.0));
}

TEST(PclSensor, OfAnOtherwiseDefaultCloudTellsNothing) {
  auto cloud = camera_frame();
  cloud.width = static_cast<std::uint32_t>(cloud.size());
  cloud.height = 1;
  EXPECT_FALSE(points_of_pcl(cloud).viewpoint);
}

TEST(PclSensor, MovesWithTheOffset) {
  auto cloud = camera_frame();
  cloud.sensor_origin_ = Eigen::Vector4f(0.5F, 0.0F, -1.0F, 0.0F);
  const Points points = points_of_pcl(cloud, glm::dvec3(1e6, 0.0, 0.0));
  EXPECT_EQ(points.viewpoint, glm::dvec3(1e6 + 0.5, 0.0, -1.0));
  EXPECT_TRUE(points.stance->is_from_sensor);
}

TEST(PclSensor, ThatIsNoNumberIsTheDefault) {
  auto cloud = camera_frame();
  cloud.sensor_origin_ = Eigen::Vector4f(kNaN, 0.0F, 0.0F, 0.0F);
  cloud.sensor_orientation_ = Eigen::Quaternionf(kNaN, 0.0F, 0.0F, 0.0F);
  EXPECT_EQ(points_of_pcl(cloud).viewpoint, glm::dvec3(0.0));
}

TEST(PclCloud, OfAModelWithoutColoursIsWhite) {
  Progress progress;
  const auto converted = convert(test::sample_sphere(500), {}, progress);
  ASSERT_TRUE(converted) << converted.error().message;
  const auto cloud = pcl_of_patches(converted->model);
  ASSERT_TRUE(cloud) << cloud.error().message;
  for (const auto& p : *cloud) EXPECT_EQ(p.rgba, 0xFFFFFFFFU);
}

}  // namespace
}  // namespace relief
