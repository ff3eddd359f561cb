#include "common/scene/views/framing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

namespace relief {
namespace {

/// Halvings of an interval: as many as a double has digits.
constexpr int kHalvings = 53;

/// Points of a model without size are seen from this many units.
constexpr double kLeastDistance = 1.0;

/// A coordinate across the view, and how far behind the origin it lies.
struct Across {
  double position;
  double behind;
};

/// How far the points reach along one side of the image, seen at a slope.
struct Reach {
  double right;  ///< max of position + slope * behind
  double left;   ///< max of slope * behind - position
};

Reach reach_of(const std::vector<Across>& points, double slope) {
  Reach reach{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Across& p : points) {
    reach.right = std::max(reach.right, p.position + slope * p.behind);
    reach.left = std::max(reach.left, slope * p.behind - p.position);
  }
  return reach;
}

/// How far behind the origin an eye is that sees all points within `slope` of its axis.
double eye_behind(const std::vector<Across>& points, double slope) {
  const Reach reach = reach_of(points, slope);
  return (reach.right + reach.left) / (2.0 * slope);
}

/// Where across the view an eye so far behind has as much room on both sides. `widest`: a slope
/// within which it sees all points.
double eye_across(const std::vector<Across>& points, double behind, double widest) {
  double least = 0.0;
  double most = widest;
  for (int i = 0; i < kHalvings; ++i) {
    const double slope = 0.5 * (least + most);
    const Reach reach = reach_of(points, slope);
    (reach.right + reach.left <= 2.0 * slope * behind ? most : least) = slope;
  }
  const Reach reach = reach_of(points, most);
  return 0.5 * (reach.right - reach.left);
}

/// The points relative to the camera's target, in eye directions.
std::vector<glm::dvec3> seen_from(const Camera& camera, std::span<const glm::dvec3> points) {
  const glm::dmat3 rotation = view_rotation(camera);
  std::vector<glm::dvec3> seen;
  seen.reserve(points.size());
  for (const glm::dvec3& p : points) seen.push_back(rotation * (p - camera.target));
  return seen;
}

std::vector<Across> along(const std::vector<glm::dvec3>& seen, glm::length_t axis) {
  std::vector<Across> points;
  points.reserve(seen.size());
  for (const glm::dvec3& p : seen) points.push_back({p[axis], p.z});
  return points;
}

/// Half the image's sides at distance 1, less the margins.
glm::dvec2 framed_slopes(const Camera& camera, double aspect) {
  const double slope = std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0) * kFramedShare;
  return {slope * aspect, slope};
}

struct Box {
  glm::dvec3 min;
  glm::dvec3 max;
};

Box box_of(const std::vector<glm::dvec3>& seen) {
  Box box{seen.front(), seen.front()};
  for (const glm::dvec3& p : seen) box = {glm::min(box.min, p), glm::max(box.max, p)};
  return box;
}

/// Where the eye of an orthographic camera is: before all points, opposite their middle.
glm::dvec3 orthographic_eye(const Box& box) {
  const double size = glm::distance(box.min, box.max);
  return {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y),
          box.max.z + (size > 0.0 ? 0.5 * size : kLeastDistance)};
}

}  // namespace

Camera framed(const Camera& camera, std::span<const glm::dvec3> points, double aspect,
              bool fits_height) {
  assert(!points.empty() && "something to frame");
  const std::vector<glm::dvec3> seen = seen_from(camera, points);
  const Box box = box_of(seen);
  Camera result = camera;
  glm::dvec3 eye = orthographic_eye(box);
  if (camera.is_orthographic()) {
    const glm::dvec3 size = box.max - box.min;
    const double height = std::max(size.y, size.x / aspect) / kFramedShare;
    if (fits_height) result.orthographic_height = height > 0.0 ? height : kLeastDistance;
  } else {
    const glm::dvec2 slopes = framed_slopes(camera, aspect);
    const auto x = along(seen, 0);
    const auto y = along(seen, 1);
    const double behind = std::max(eye_behind(x, slopes.x), eye_behind(y, slopes.y));
    if (behind > box.max.z)
      eye = {eye_across(x, behind, slopes.x), eye_across(y, behind, slopes.y), behind};
  }
  const glm::dmat3 to_world = glm::transpose(view_rotation(camera));
  const double middle = 0.5 * (box.min.z + box.max.z);
  result.eye = camera.target + to_world * eye;
  result.target = camera.target + to_world * glm::dvec3(eye.x, eye.y, middle);
  return result;
}

double framing_distance(const Camera& camera, std::span<const glm::dvec3> points, double aspect) {
  assert(!points.empty() && "something to frame");
  const glm::dvec2 slopes = framed_slopes(camera, aspect);
  double distance = 0.0;
  for (const glm::dvec3& p : seen_from(camera, points)) {
    distance = std::max({distance, p.z + std::abs(p.x) / slopes.x, p.z + std::abs(p.y) / slopes.y});
  }
  return distance > 0.0 ? distance : kLeastDistance;
}

double framing_height(const Camera& camera, std::span<const glm::dvec3> points, double aspect) {
  const glm::dmat3 rotation = view_rotation(camera);
  double half = 0.0;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 seen = rotation * (p - camera.eye);
    half = std::max({half, std::abs(seen.y), std::abs(seen.x) / aspect});
  }
  return half > 0.0 ? 2.0 * half / kFramedShare : kLeastDistance;
}

}  // namespace relief
