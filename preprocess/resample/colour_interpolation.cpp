#include "preprocess/resample/colour_interpolation.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "common/image/srgb.h"

namespace relief {
namespace {

/// Number of points that a colour is interpolated from. A checker of 11 spacings, points at random:
/// 12 and 8 differ by 0.05 dB.
constexpr int kMaxPoints = 8;
/// Gradients are fitted with weights exp(-d^2 / s^2), and averaged with others, s in local scan
/// spacings; points farther than this many scales are ignored.
constexpr double kGradientScale = 1.5;
constexpr double kTensorScale = 1.2;
constexpr double kCutoff = 2.0;
/// Search radius for kriging, in spacings.
constexpr double kReach = 3.0;
/// Largest factor by which distances shrink along an edge and grow across it. Checker of 11
/// spacings, points on a loose grid: 1: 15.5 dB, 2: 16.8, 3: 17.3 with smoother gradients.
constexpr double kMaxSteering = 3.0;
/// Changes of colour per spacing below which there is no edge, and the ridge on gradients: noise of
/// 8-bit colours.
constexpr double kNoise = 0.02;
constexpr double kRidge = 1e-2;
/// Assumed distance of coinciding points, in spacings: they count as their mean.
constexpr double kNugget = 0.02;
/// Slopes are limited to 84 degrees, like those of tangent planes.
constexpr float kMinCosine = 0.1F;

using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxPoints + 1, 1>;
using Equations =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxPoints + 1, kMaxPoints + 1>;

/// Maps offsets on the base plane to offsets along a surface with this normal, up to a rotation.
glm::dmat2 along_surface(glm::vec3 normal) {
  const glm::dvec2 slope = glm::dvec2(normal) / double{std::max(normal.z, kMinCosine)};
  const double squared = glm::dot(slope, slope);
  if (squared < 1e-12) return glm::dmat2(1.0);
  const double stretch = (std::sqrt(1.0 + squared) - 1.0) / squared;
  return glm::dmat2(1.0) + stretch * glm::outerProduct(slope, slope);
}

std::vector<glm::vec3> linear_colours(const PatchPoints& points,
                                      const std::vector<glm::u8vec3>& colours) {
  std::vector<glm::vec3> linear;
  linear.reserve(points.size());
  for (const std::uint32_t id : points.ids) linear.push_back(linear_from_srgb8(colours[id]));
  return linear;
}

}  // namespace

struct ColourInterpolation::Metric {
  glm::dmat2 frame{1.0};  ///< of offsets on the base plane, in spacings

  [[nodiscard]] double distance(glm::dvec2 offset) const { return glm::length(frame * offset); }
};

ColourInterpolation::ColourInterpolation(const PatchPoints& points, const PointGrid& lookup,
                                         const std::vector<glm::u8vec3>& colours)
    : ColourInterpolation(points, lookup, linear_colours(points, colours)) {}

ColourInterpolation::ColourInterpolation(const PatchPoints& points, const PointGrid& lookup,
                                         std::vector<glm::vec3> values)
    : points_(points), lookup_(lookup), values_(std::move(values)) {
  tensors_.reserve(points.size());
  for (std::uint32_t p = 0; p < points.size(); ++p) tensors_.push_back(gradient_at(p));
}

ColourInterpolation::Tensor ColourInterpolation::gradient_at(std::uint32_t point) const {
  const glm::dvec3 middle = points_.positions[point];
  const double scale = kGradientScale * points_.spacing[point];
  // The normal equations of a linear function: 1, x, y in scales.
  glm::dmat3 sums(0.0);
  std::array<glm::dvec3, 3> right{};
  lookup_.for_each_within(middle.x, middle.y, kCutoff * scale, [&](std::uint32_t p, double square) {
    const double weight = std::exp(-square / (scale * scale));
    const glm::dvec3 basis(1.0, (points_.positions[p].x - middle.x) / scale,
                           (points_.positions[p].y - middle.y) / scale);
    sums += weight * glm::outerProduct(basis, basis);
    const glm::dvec3 value(values_[p] - values_[point]);
    for (glm::length_t k = 0; k < 3; ++k)
      right[static_cast<std::size_t>(k)] += weight * basis[k] * value;
  });
  sums[1][1] += kRidge;
  sums[2][2] += kRidge;
  const glm::dmat3 inverse = glm::inverse(sums);
  glm::dvec3 along_x(0.0);
  glm::dvec3 along_y(0.0);
  for (glm::length_t k = 0; k < 3; ++k) {
    along_x += inverse[k][1] * right[static_cast<std::size_t>(k)];
    along_y += inverse[k][2] * right[static_cast<std::size_t>(k)];
  }
  return Tensor(glm::dot(along_x, along_x), glm::dot(along_x, along_y),
                glm::dot(along_y, along_y)) /
         (scale * scale);
}

ColourInterpolation::Metric ColourInterpolation::metric_at(double x, double y,
                                                           std::uint32_t nearest) const {
  const double spacing = points_.spacing[nearest];
  const double scale = kTensorScale * spacing;
  Tensor sum(0.0);
  double weights = 0.0;
  lookup_.for_each_within(x, y, kCutoff * scale, [&](std::uint32_t p, double square) {
    const double weight = std::exp(-square / (scale * scale));
    sum += weight * tensors_[p];
    weights += weight;
  });
  const glm::dmat2 surface = along_surface(points_.normals[nearest]) / spacing;
  if (weights <= 0.0) return {surface};
  const glm::dmat2 gradients = glm::dmat2(sum.x, sum.y, sum.y, sum.z) / weights;
  const glm::dmat2 back = glm::inverse(surface);  // symmetric
  const glm::dmat2 tensor = back * gradients * back;
  const double mean = 0.5 * (tensor[0][0] + tensor[1][1]);
  const double half = 0.5 * (tensor[0][0] - tensor[1][1]);
  const double reach = std::hypot(half, tensor[0][1]);
  const double across = mean + reach + kNoise * kNoise;
  const double along = std::max(mean - reach, 0.0) + kNoise * kNoise;
  const double steering = std::min(kMaxSteering, std::sqrt(std::sqrt(across / along)));
  const double turn = 0.5 * std::atan2(tensor[0][1], half);
  const glm::dvec2 edge(std::cos(turn), std::sin(turn));  // across it
  const glm::dmat2 steered =
      glm::dmat2(1.0 / steering) + (steering - 1.0 / steering) * glm::outerProduct(edge, edge);
  return {steered * surface};
}

glm::vec3 ColourInterpolation::at(double x, double y, std::uint32_t nearest) const {
  const Metric metric = metric_at(x, y, nearest);
  const glm::dvec2 position(x, y);
  const double to_nearest = glm::length(glm::dvec2(points_.positions[nearest]) - position);
  const double reach = std::max(kReach * points_.spacing[nearest], 2.0 * to_nearest);
  std::vector<std::pair<double, std::uint32_t>> around;
  around.reserve(64);
  lookup_.for_each_within(x, y, reach, [&](std::uint32_t p, double /*square*/) {
    around.emplace_back(metric.distance(glm::dvec2(points_.positions[p]) - position), p);
  });
  const auto count = std::min<std::ptrdiff_t>(kMaxPoints, std::ssize(around));
  std::partial_sort(around.begin(), around.begin() + count, around.end());

  glm::vec3 low = values_[around.front().second];
  glm::vec3 high = low;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    low = glm::min(low, values_[around[i].second]);
    high = glm::max(high, values_[around[i].second]);
  }
  if (low == high) return low;

  Equations equations(count + 1, count + 1);
  Weights weights(count + 1);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const glm::dvec2 p(points_.positions[around[i].second]);
    for (std::ptrdiff_t j = 0; j < i; ++j) {
      const glm::dvec2 q(points_.positions[around[j].second]);
      equations(i, j) = equations(j, i) = metric.distance(p - q);
    }
    equations(i, i) = -kNugget;
    equations(i, count) = equations(count, i) = 1.0;
    weights(i) = around[i].first;
  }
  equations(count, count) = 0.0;
  weights(count) = 1.0;
  weights = Eigen::PartialPivLU<Equations>(equations).solve(weights).eval();
  glm::dvec3 colour(0.0);
  for (std::ptrdiff_t i = 0; i < count; ++i)
    colour += weights(i) * glm::dvec3(values_[around[i].second]);
  return glm::clamp(glm::vec3(colour), low, high);
}

}  // namespace relief
