#include "preprocess/frame/working_frame.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

namespace relief {
namespace {

// Variances that differ by less than this share tell no axes apart: on a symmetric body the
// difference is where its points happen to lie.
constexpr double kLeastDifference = 1e-3;
// The third moment of points beside the cube of their standard deviation. Less is rounding.
constexpr double kLeastSkewness = 1e-6;

// Positions in the frame are multiples of 2^-40 units, which are a few thousand times as coarse as
// what turning rounds: whichever way a scan lies, they are the same, and so are ties among them.
constexpr double kSteps = 1099511627776.0;

/// The world's axes among which a unit vector turns least.
glm::dvec3 world_axis_across(const glm::dvec3& axis) {
  const glm::dvec3 along = glm::abs(axis);
  if (along.x <= along.y && along.x <= along.z) return {1.0, 0.0, 0.0};
  return along.y <= along.z ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
}

/// Columns: an axis, and two across it that are as near to the world's as can be.
glm::dmat3 axes_about(const glm::dvec3& axis) {
  const glm::dvec3 world = world_axis_across(axis);
  const glm::dvec3 across = glm::normalize(world - glm::dot(world, axis) * axis);
  return {axis, across, glm::cross(axis, across)};
}

/// On which side the points reach farther along an axis: 1, -1, or 0 if on both alike.
double longer_side(const std::vector<glm::dvec3>& positions, const glm::dvec3& mean,
                   double deviation, const glm::dvec3& axis) {
  double third = 0.0;
  for (const glm::dvec3& p : positions) {
    const double along = glm::dot(p - mean, axis) / deviation;
    third += along * along * along;
  }
  if (!(std::abs(third) >= kLeastSkewness * static_cast<double>(positions.size()))) return 0.0;
  return third < 0.0 ? -1.0 : 1.0;
}

/// The side of an axis that the world's axis nearest to it points to: 1 or -1.
double side_of_world(const glm::dvec3& axis) {
  const glm::dvec3 size = glm::abs(axis);
  const int largest = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  return axis[largest] < 0.0 ? -1.0 : 1.0;
}

glm::dvec3 mean_of(const std::vector<glm::dvec3>& positions) {
  // About the first, so that a scan far from the origin keeps its digits.
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : positions) sum += p - positions.front();
  return positions.front() + sum / static_cast<double>(positions.size());
}

Eigen::Matrix3d covariance_of(const std::vector<glm::dvec3>& positions, const glm::dvec3& mean) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const glm::dvec3& p : positions) {
    const Eigen::Vector3d d(p.x - mean.x, p.y - mean.y, p.z - mean.z);
    sum += d * d.transpose();
  }
  return sum / static_cast<double>(positions.size());
}

bool is_left_handed(const WorkingFrame& frame) {
  return glm::determinant(frame.axes) < 0.0;
}

/// Turns triangles round, which a mirror has made clockwise, and their mirrored textures.
void reverse_triangles(Points& points) {
  for (Triangle& triangle : points.triangles) std::swap(triangle[1], triangle[2]);
  for (CornerTexcoords& corners : points.corner_texcoords) std::swap(corners[1], corners[2]);
  for (CornerTangents& corners : points.corner_tangents) {
    std::swap(corners[1], corners[2]);
    for (glm::vec4& tangent : corners) tangent.w = -tangent.w;
  }
}

template <class Texel>
std::vector<Texel> transposed(const std::vector<Texel>& rows, std::uint32_t width) {
  std::vector<Texel> columns;
  columns.reserve(rows.size());
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t k = i; k < rows.size(); k += width) columns.push_back(rows[k]);
  }
  return columns;
}

template <class Texel>
void transpose(AttributeMap<Texel>& map) {
  map.texels = transposed(map.texels, map.width);
  std::swap(map.width, map.height);
}

/// Exchanges the axes of a patch, without moving a sample: a left-handed one becomes right-handed.
/// Unlike reversed columns this keeps the diagonal along which cells are halved.
void transpose(Patch& patch) {
  std::swap(patch.axes[0], patch.axes[1]);
  patch.heights = transposed(patch.heights, patch.width);
  std::swap(patch.width, patch.height);
  transpose(patch.normals);
  for (glm::i16vec2& normal : patch.normals.texels) std::swap(normal.x, normal.y);
  transpose(patch.colours);
  for (auto& scalar : patch.scalars) transpose(scalar);
}

}  // namespace

WorkingFrame working_frame(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) return {};
  const glm::dvec3 mean = mean_of(positions);
  const Eigen::Matrix3d covariance = covariance_of(positions, mean);
  if (!covariance.allFinite()) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0.0);  // ascending
  const auto side = [&](int k, const glm::dvec3& axis) {
    return longer_side(positions, mean, std::sqrt(variances[k]), axis);
  };
  const auto axis = [&](int k) {
    const Eigen::Vector3d v = solver.eigenvectors().col(k);
    const glm::dvec3 either(v[0], v[1], v[2]);
    const double own = side(k, either);
    return either * (own != 0.0 ? own : side_of_world(either));
  };
  const double least = kLeastDifference * variances[2];
  const bool is_long = variances[2] - variances[1] > least;
  const bool is_flat = variances[1] - variances[0] > least;
  if (is_long && is_flat) {
    const glm::dvec3 longest = axis(2);
    const glm::dvec3 second = axis(1);
    const glm::dvec3 right_handed = glm::cross(longest, second);
    return {mean, {longest, second, right_handed * (side(0, right_handed) < 0.0 ? -1.0 : 1.0)}};
  }
  if (is_long) return {mean, axes_about(axis(2))};
  if (is_flat) return {mean, axes_about(axis(0))};
  return {};
}

glm::dvec3 to_working_frame(const WorkingFrame& frame, const glm::dvec3& position) {
  return (position - frame.origin) * frame.axes;
}

glm::dvec3 on_steps(const glm::dvec3& in_frame, double unit) {
  const double steps = kSteps / unit;
  return glm::round(in_frame * steps) / steps;
}

SideChoice to_working_frame(const WorkingFrame& frame, SideChoice side) {
  side.toward = to_working_frame(frame, side.toward);
  side.up = side.up * frame.axes;
  return side;
}

void to_working_frame(const WorkingFrame& frame, Points& points) {
  if (frame == WorkingFrame{}) return;
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    glm::dvec3& p = points.positions[i];
    p = on_steps(to_working_frame(frame, p));
  });
  for (glm::vec3& normal : points.normals) normal = glm::dvec3(normal) * frame.axes;
  for (CornerTangents& corners : points.corner_tangents) {
    for (glm::vec4& tangent : corners) tangent = {glm::dvec3(tangent) * frame.axes, tangent.w};
  }
  if (is_left_handed(frame)) reverse_triangles(points);
  if (points.viewpoint) *points.viewpoint = to_working_frame(frame, *points.viewpoint);
  for (glm::dvec3& scanner : points.scanners) scanner = to_working_frame(frame, scanner);
}

void to_world_frame(const WorkingFrame& frame, std::vector<Patch>& patches) {
  if (frame == WorkingFrame{}) return;
  const bool left_handed = is_left_handed(frame);
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    Patch& patch = patches[p];
    patch.origin = frame.origin + frame.axes * patch.origin;
    patch.axes = frame.axes * patch.axes;
    if (left_handed) transpose(patch);
  });
}

}  // namespace relief
