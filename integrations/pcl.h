// Point clouds of the Point Cloud Library (PCL): in as Points, out as samples of patches. Header
// only: a program that includes it has PCL itself, and links relief::preprocess and
// relief::renderer.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "preprocess/readers/pcd/sensor_stance.h"
#include "preprocess/readers/read_points.h"
#include "renderer/geometry/meshes/points_of_patches.h"

namespace relief {

/// Point types of PCL, or of its users, with members of these names.
template <class Point>
concept HasPclNormal = requires(Point p) {
  p.normal_x = p.normal_y = p.normal_z = 0.0F;
};
template <class Point>
concept HasPclColour = requires(Point p) {
  p.r = p.g = p.b = std::uint8_t{0};
};

/// Returns the points of a cloud as convert() takes them: without those that are NaN or infinite,
/// and equal positions merged (clean_points). Normals and colours (sRGB) are taken if the type of
/// the points has them; normals that are 0 or NaN are estimated later.
///
/// PCL has single precision, so that users subtract an offset from coordinates of surveys:
/// `offset` is added again, in double precision. The sensor's pose counts as that of a PCD file
/// does: it tells the side that normals face, if it is not the default or the cloud is organised,
/// and how the points stand. The cloud has fewer than 2^32 - 1 points.
template <class Point>
[[nodiscard]] Points points_of_pcl(const pcl::PointCloud<Point>& cloud,
                                   glm::dvec3 offset = glm::dvec3(0.0)) {
  Points points;
  points.positions.reserve(cloud.size());
  if constexpr (HasPclNormal<Point>) points.normals.reserve(cloud.size());
  if constexpr (HasPclColour<Point>) points.colours.reserve(cloud.size());
  for (const Point& p : cloud.points) {
    points.positions.emplace_back(p.x, p.y, p.z);
    if constexpr (HasPclNormal<Point>)
      points.normals.emplace_back(p.normal_x, p.normal_y, p.normal_z);
    if constexpr (HasPclColour<Point>) points.colours.emplace_back(p.r, p.g, p.b);
  }

  SensorPose pose;
  const auto& origin = cloud.sensor_origin_;
  const auto& orientation = cloud.sensor_orientation_;
  if (origin.template head<3>().allFinite())
    pose.position = glm::dvec3(origin.x(), origin.y(), origin.z());
  const glm::dquat turn(orientation.w(), orientation.x(), orientation.y(), orientation.z());
  // Anything but a rotation is as good as the default.
  if (std::abs(glm::length(turn) - 1.0) < 0.01) pose.turn = glm::normalize(turn);
  const bool is_default = pose.position == glm::dvec3(0.0) && pose.turn == SensorPose().turn;
  if (!is_default || cloud.height > 1) points.viewpoint = pose.position + offset;
  points.stance = sensor_stance(points.positions, pose);

  for (glm::dvec3& position : points.positions) position += offset;
  return clean_points(std::move(points)).points;
}

/// Returns the samples of all patches (sample_points) as a cloud, with normals and sRGB colours if
/// the type of the points has them. Colours are white where the model has none. `offset` is
/// subtracted before positions are rounded to single precision. Fails if there are more samples
/// than 32 bits count.
template <class Point = pcl::PointXYZRGBNormal>
[[nodiscard]] Result<pcl::PointCloud<Point>> pcl_of_patches(const PatchModel& model,
                                                            glm::dvec3 offset = glm::dvec3(0.0)) {
  RELIEF_TRY_ASSIGN(const Points samples, sample_points(model));
  pcl::PointCloud<Point> cloud;
  cloud.reserve(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const glm::vec3 position(samples.positions[k] - offset);
    Point p;
    p.x = position.x;
    p.y = position.y;
    p.z = position.z;
    if constexpr (HasPclNormal<Point>) {
      p.normal_x = samples.normals[k].x;
      p.normal_y = samples.normals[k].y;
      p.normal_z = samples.normals[k].z;
    }
    if constexpr (HasPclColour<Point>) {
      const glm::u8vec3 colour = samples.colours.empty() ? glm::u8vec3(255) : samples.colours[k];
      p.r = colour.r;
      p.g = colour.g;
      p.b = colour.b;
    }
    cloud.push_back(p);
  }
  return cloud;
}

}  // namespace relief
