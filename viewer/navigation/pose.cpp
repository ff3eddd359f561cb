#include "viewer/navigation/pose.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace relief {
namespace {

/// Least distance of eye and target, as a share of their coordinates: their rounding, 1e-16 of
/// them, then turns the line of sight by 1e-8 at most, 1e-5 pixels of an image 1000 pixels high.
constexpr double kLeastTargetShare = 1e-8;

/// Directions closer than this (sine) are the same.
constexpr double kParallel = 1e-6;

bool is_position(glm::dvec3 v) {
  return glm::length(v) <= kMostCoordinate;
}

}  // namespace

Pose pose_of(const Camera& camera, glm::dvec3 origin) {
  assert(is_usable(camera));
  Pose pose;
  pose.eye = camera.eye - origin;
  pose.turn = glm::normalize(glm::quat_cast(glm::transpose(view_rotation(camera))));
  pose.focus = glm::distance(camera.eye, camera.target);
  pose.vertical_fov_degrees = camera.vertical_fov_degrees;
  pose.orthographic_height = std::max(camera.orthographic_height, 0.0);
  return pose;
}

Camera camera_of(const Pose& pose, glm::dvec3 origin) {
  Camera camera;
  camera.eye = origin + pose.eye;
  const glm::dvec3 size = glm::abs(camera.eye);
  const double largest = std::max({size.x, size.y, size.z});
  const double distance = std::max(pose.focus, kLeastTargetShare * largest);
  camera.target = origin + (pose.eye - distance * pose.backward());
  camera.up = pose.up();
  camera.vertical_fov_degrees = pose.vertical_fov_degrees;
  camera.orthographic_height = pose.orthographic_height;
  return camera;
}

bool is_usable(const Camera& camera) {
  return is_position(camera.eye) && is_position(camera.target) && is_position(camera.up) &&
         glm::distance(camera.eye, camera.target) > 0.0 && glm::length(camera.up) > 0.0 &&
         camera.orthographic_height <= kMostCoordinate && camera.vertical_fov_degrees > 0.0 &&
         camera.vertical_fov_degrees < 180.0;
}

Camera with_usable_up(const Camera& camera) {
  const glm::dvec3 across =
      glm::cross(glm::normalize(camera.up), glm::normalize(camera.target - camera.eye));
  if (glm::length(across) >= kParallel) return camera;
  Camera result = camera;
  result.up = glm::transpose(view_rotation(camera))[1];
  return result;
}

double slope_of(const Pose& pose) {
  return std::tan(glm::radians(pose.vertical_fov_degrees) / 2.0);
}

double depth_of(const Pose& pose, glm::dvec3 point) {
  return glm::dot(pose.eye - point, pose.backward());
}

double image_height_at(const Pose& pose, double depth) {
  return pose.is_orthographic() ? pose.orthographic_height : 2.0 * depth * slope_of(pose);
}

Pose turned(const Pose& pose, const glm::dquat& rotation, glm::dvec3 about) {
  Pose result = pose;
  result.eye = about + rotation * (pose.eye - about);
  result.turn = glm::normalize(rotation * pose.turn);
  return result;
}

}  // namespace relief
